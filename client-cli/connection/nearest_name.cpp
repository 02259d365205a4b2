#include "connection/nearest_name.h"

#include <chrono>
#include <string_view>
#include <vector>

#include "case_file/suggestion.h"

namespace cellcrush::client {

namespace {

constexpr std::string_view kPreset = "preset:";
constexpr std::chrono::seconds kProbePatience{5};

// A call that may fail: whether it went well.
template <typename Stub, typename Request, typename Response>
bool probe(Stub& stub, grpc::Status (Stub::*method)(grpc::ClientContext*, const Request&, Response*),
           const Request& request, Response& response) {
  grpc::ClientContext context;
  context.set_deadline(std::chrono::system_clock::now() + kProbePatience);
  return (stub.*method)(&context, request, &response).ok();
}

std::string find_nearest_preset(const std::string& word, v1::Cases::Stub& cases) {
  v1::ListPresetsResponse presets;
  if (!probe(cases, &v1::Cases::Stub::ListPresets, v1::ListPresetsRequest(), presets)) return {};
  std::vector<std::string> names;
  for (const v1::Preset& preset : presets.presets()) names.push_back(preset.name());
  const std::string nearest = find_nearest(word, names);
  return nearest.empty() ? nearest : std::string(kPreset) + nearest;
}

}  // namespace

std::string find_nearest_name(const std::string& name, v1::Cases::Stub& cases, v1::Jobs::Stub& jobs,
                              v1::Sweeps::Stub& sweeps) {
  if (name.starts_with(kPreset)) return find_nearest_preset(name.substr(kPreset.size()), cases);
  const std::string number = name.substr(name.find_last_not_of("0123456789") + 1);
  if (number.empty()) return find_nearest_preset(name.substr(name.rfind('/') + 1), cases);
  std::vector<std::string> names;
  v1::GetJobRequest job;
  job.set_name("jobs/" + number);
  v1::Job found_job;
  if (probe(jobs, &v1::Jobs::Stub::GetJob, job, found_job)) names.push_back(job.name());
  v1::GetSweepRequest sweep;
  sweep.set_name("sweeps/" + number);
  v1::Sweep found_sweep;
  if (probe(sweeps, &v1::Sweeps::Stub::GetSweep, sweep, found_sweep)) names.push_back(sweep.name());
  return names.size() == 1 ? names.front() : find_nearest(name, names);
}

}  // namespace cellcrush::client

#include "server/job_numbers.h"

#include <thread>

#include "store/result_reader.h"

namespace cellcrush::testing {

JobNumbers numbers_of(Client& client, const std::filesystem::path& data_folder, const std::string& job) {
  JobNumbers out;
  const store::ResultReader result(data_folder / job / "result.h5");
  for (const auto& sample : result.history()) out.history.push_back(sample.SerializeAsString());
  const int frames = static_cast<int>(result.frame_times().size());
  for (int i = 0; i < frames; ++i) out.frames.push_back(result.frame(i).SerializeAsString());
  auto summary = client.get(job).summary();
  summary.clear_solver_seconds();
  summary.clear_stage_times();
  out.summary = summary.SerializeAsString();
  return out;
}

void wait_for_samples(Client& client, const std::string& job, std::size_t count) {
  for (int i = 0; i < 600 && client.history(job).size() < count; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
}

}  // namespace cellcrush::testing

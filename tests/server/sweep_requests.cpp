#include "server/sweep_requests.h"

#include "server/daemon_process.h"

namespace cellcrush::testing {

v1::CreateSweepRequest sweep_of(const v1::Case& submitted, const std::string& field,
                                const std::vector<double>& values) {
  v1::CreateSweepRequest out;
  *out.mutable_sweep()->mutable_case_() = submitted;
  auto& axis = *out.mutable_sweep()->add_axes();
  axis.set_field(field);
  axis.mutable_list()->mutable_values()->Add(values.begin(), values.end());
  return out;
}

v1::Sweep create(Client& client, const v1::CreateSweepRequest& request) {
  return answer_of(*client.sweeps, &v1::Sweeps::Stub::CreateSweep, request);
}

v1::Sweep get_sweep(Client& client, const std::string& name) {
  return answer_of(*client.sweeps, &v1::Sweeps::Stub::GetSweep, named<v1::GetSweepRequest>(name));
}

v1::Sweep cancel_sweep(Client& client, const std::string& name) {
  return answer_of(*client.sweeps, &v1::Sweeps::Stub::CancelSweep, named<v1::CancelSweepRequest>(name));
}

v1::Sweep retry(Client& client, const std::string& name) {
  return answer_of(*client.sweeps, &v1::Sweeps::Stub::RetryFailedJobs, named<v1::RetryFailedJobsRequest>(name));
}

v1::SweepTable table_of(Client& client, const std::string& name) {
  return answer_of(*client.sweeps, &v1::Sweeps::Stub::GetSweepTable, named<v1::GetSweepTableRequest>(name));
}

int count_in(const v1::Sweep& sweep, v1::Job::State state) {
  const auto found = sweep.state_counts().find(v1::Job::State_Name(state));
  return found == sweep.state_counts().end() ? 0 : found->second;
}

bool wait_for_count(Client& client, const std::string& name, v1::Job::State state, int count) {
  return wait_until([&] { return count_in(get_sweep(client, name), state) == count; }, std::chrono::seconds(60));
}

WatchedSweep watch_sweep(Client& client, const std::string& name, const std::string& token, int tokens) {
  auto request = named<v1::WatchSweepRequest>(name);
  request.set_resume_token(token);
  const auto context = bounded_context();
  const auto reader = client.sweeps->WatchSweep(context.get(), request);
  WatchedSweep out;
  v1::WatchSweepResponse response;
  while (tokens != 0 && reader->Read(&response)) {
    if (!response.resume_token().empty()) --tokens;
    out.responses.push_back(response);
  }
  if (tokens == 0) context->TryCancel();
  while (reader->Read(&response)) {
  }
  out.status = reader->Finish();
  return out;
}

}  // namespace cellcrush::testing

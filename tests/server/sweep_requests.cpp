#include "server/sweep_requests.h"

#include <thread>

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
  v1::Sweep out;
  const auto status = client.sweeps->CreateSweep(bounded_context().get(), request, &out);
  EXPECT_TRUE(status.ok()) << status.error_message();
  return out;
}

v1::Sweep get_sweep(Client& client, const std::string& name) {
  v1::GetSweepRequest request;
  request.set_name(name);
  v1::Sweep out;
  const auto status = client.sweeps->GetSweep(bounded_context().get(), request, &out);
  EXPECT_TRUE(status.ok()) << status.error_message();
  return out;
}

int count_in(const v1::Sweep& sweep, v1::Job::State state) {
  const auto found = sweep.state_counts().find(v1::Job::State_Name(state));
  return found == sweep.state_counts().end() ? 0 : found->second;
}

bool wait_for_count(Client& client, const std::string& name, v1::Job::State state, int count) {
  for (int i = 0; i < 1200; ++i) {
    if (count_in(get_sweep(client, name), state) == count) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  return false;
}

WatchedSweep watch_sweep(Client& client, const std::string& name, const std::string& token, int tokens) {
  v1::WatchSweepRequest request;
  request.set_name(name);
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

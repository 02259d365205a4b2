#include "server/job_numbers.h"

#include "server/daemon_process.h"
#include "server/watch_contract.h"
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

grpc::Status watch_soundly(Client& client, const std::string& job, std::int64_t after, std::int64_t* last) {
  WatchContract contract(after);
  const auto watched = client.watch(job, after, false, [&](const v1::JobEvent& event) { contract.see(event); });
  contract.end(watched.status);
  for (const auto& broken : contract.broken()) ADD_FAILURE() << job << ": " << broken;
  if (last != nullptr) *last = contract.sequence();
  return watched.status;
}

void expect_success(Client& client, const std::string& job) {
  EXPECT_TRUE(client.watch(job).status.ok());
  EXPECT_EQ(client.get(job).state(), v1::Job::SUCCEEDED) << job << ": " << client.get(job).cause_message();
}

std::string create_with_samples(Client& client, const v1::Case& submitted, std::size_t count) {
  std::string job = client.create(submitted);
  wait_for_samples(client, job, count);
  return job;
}

void wait_for_samples(Client& client, const std::string& job, std::size_t count) {
  wait_until([&] { return client.history(job).size() >= count; }, std::chrono::seconds(12));
}

}  // namespace cellcrush::testing

// How soon a daemon with many waiting jobs serves.
#include <gtest/gtest.h>

#include <chrono>
#include <iostream>

#include "faults/fault_fixture.h"
#include "faults/filled_journal.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

using RestartTest = FaultFixture;

TEST_F(RestartTest, ADaemonWithManyWaitingJobsServesSoon) {
  const int count = rounds(1000, 10'000);
  fill_journal(data_folder(), count, endless_case());
  const auto start = std::chrono::steady_clock::now();
  start_daemon({"--workers", "1"});
  const double listening = seconds_since(start);
  auto client = this->client();
  EXPECT_EQ(client.get("jobs/" + std::to_string(count)).state(), v1::Job::PENDING);
  const double serving = seconds_since(start);
  EXPECT_TRUE(client.wait_for_state("jobs/1", v1::Job::RUNNING));
  const double running = seconds_since(start);
  EXPECT_LT(serving, is_full_round() ? 5.0 : 15.0);
  EXPECT_EQ(all_jobs(client).size(), static_cast<std::size_t>(count));
  std::cout << count << " waiting jobs: listens after " << listening << " s, serves after " << serving
            << " s, runs the first after " << running << " s\n";
}

}  // namespace
}  // namespace cellcrush::testing

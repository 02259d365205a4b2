// The bits of a job whose workers are killed.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <random>
#include <thread>
#include <utility>

#include "faults/fault_fixture.h"
#include "server/job_numbers.h"
#include "server/small_case.h"
#include "store/job_state.h"

namespace cellcrush::testing {
namespace {

class WorkerKillTest : public FaultFixture {
 protected:
  // Runs the case and kills its workers at random moments, at most so many. How many were.
  static int run_and_kill(Client& client, const std::string& job, std::mt19937& random, int most) {
    pid_t last = 0;
    for (int kills = 0; kills < most;) {
      wait_for_samples(client, job, client.history(job).size() + 5);
      std::this_thread::sleep_for(std::chrono::milliseconds(random() % 150));
      const auto now = client.get(job);
      if (store::is_terminal(now.state())) return kills;
      const auto worker = static_cast<pid_t>(now.worker_pid());
      if (worker == 0 || worker == std::exchange(last, worker)) continue;
      if (kill(worker, SIGKILL) == 0) ++kills;
    }
    return most;
  }

  // What the workers left goes soon after the job's end.
  void expect_nothing_left(const std::string& job) const {
    const auto reports = data_folder() / job / "reports";
    EXPECT_TRUE(wait_until([&reports] { return !std::filesystem::exists(reports); }));
    EXPECT_FALSE(std::filesystem::exists(data_folder() / job / "checkpoint"));
  }
};

TEST_F(WorkerKillTest, AJobWhoseWorkersAreKilledAtRandomMomentsHasTheSameBits) {
  start_daemon({"--workers", "1", "--checkpoint-interval", "0.05"});
  auto client = this->client();
  const std::string whole = client.create(case_of_seconds());
  ASSERT_TRUE(client.watch(whole).status.ok());
  const auto expected = numbers_of(client, data_folder(), whole);
  ASSERT_GT(expected.history.size(), 100U);

  std::mt19937 random(7);
  const int wanted = rounds(5, 25);
  int kills = 0;
  int jobs = 0;
  int workers = 0;
  for (; kills < wanted && jobs < 2 * wanted; ++jobs) {
    const std::string job = client.create(case_of_seconds());
    kills += run_and_kill(client, job, random, wanted - kills);
    EXPECT_TRUE(watch_soundly(client, job).ok());
    const auto ended = client.get(job);
    workers += ended.attempt();
    ASSERT_EQ(ended.state(), v1::Job::SUCCEEDED) << ended.cause_message();
    EXPECT_TRUE(numbers_of(client, data_folder(), job) == expected);
    EXPECT_EQ(client.history(job).size(), expected.history.size());
    expect_nothing_left(job);
  }
  EXPECT_GT(workers, jobs);
  std::cout << kills << " kills, " << workers << " workers, " << jobs << " jobs with the same bits\n";
}

}  // namespace
}  // namespace cellcrush::testing

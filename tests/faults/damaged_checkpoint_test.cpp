// Checkpoints that a disk has damaged while there was no daemon.
#include <gmock/gmock.h>

#include <csignal>
#include <filesystem>
#include <iostream>
#include <random>
#include <thread>

#include "faults/fault_fixture.h"
#include "server/job_numbers.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class DamagedCheckpointTest : public FaultFixture {
 protected:
  void SetUp() override {
    start_daemon(arguments_);
    auto client = this->client();
    const std::string whole = client.create(case_of_seconds());
    ASSERT_TRUE(client.watch(whole).status.ok());
    expected_ = numbers_of(client, data_folder(), whole);
    stop_daemon();
  }

  // Runs the case up to a random place behind two checkpoints, then kills the daemon and the worker. The job.
  std::string leave_a_job() {
    start_daemon(arguments_);
    auto client = this->client();
    std::string job = client.create(case_of_seconds());
    wait_for_samples(client, job, 30 + random_() % 60);
    const pid_t worker = client.worker_of(job);
    kill_daemon();
    kill_between_checkpoints(job, worker);
    return job;
  }

  // While one takes the other's place, there is one alone.
  void kill_between_checkpoints(const std::string& job, pid_t worker) const {
    const auto has_both = [&] {
      return std::filesystem::exists(checkpoint(job)) &&
             std::filesystem::exists(checkpoint(job, "checkpoint.previous"));
    };
    for (int i = 0; i < 500; ++i) {
      kill(worker, SIGSTOP);
      if (has_both()) break;
      kill(worker, SIGCONT);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    EXPECT_TRUE(has_both());
    kill(worker, SIGKILL);
    EXPECT_TRUE(wait_until_gone(worker, std::chrono::seconds(5)));
  }

  // Lets the next daemon end the job, which has the same bits. Its log.
  std::string end_job(const std::string& job) {
    start_daemon(arguments_);
    auto client = this->client();
    expect_success(client, job);
    EXPECT_TRUE(numbers_of(client, data_folder(), job) == expected_);
    return stop_daemon();
  }

  [[nodiscard]] std::filesystem::path checkpoint(const std::string& job, const char* name = "checkpoint") const {
    return data_folder() / job / name;
  }

  void tear(const std::filesystem::path& path) {
    std::filesystem::resize_file(path, random_() % std::filesystem::file_size(path));
  }

  void flip_a_bit(const std::filesystem::path& path) {
    const auto place = random_() % std::filesystem::file_size(path);
    flip_bits(path, place, 1U << random_() % 8);
  }

  const std::vector<std::string> arguments_ = {"--workers", "1", "--checkpoint-interval", "0.05"};
  std::mt19937 random_{5};
  JobNumbers expected_;
};

TEST_F(DamagedCheckpointTest, OneDamagedIsReplacedByThePreviousOne) {
  const int count = rounds(2, 20);
  for (int i = 0; i < count; ++i) {
    const std::string job = leave_a_job();
    if (i % 2 == 0) {
      tear(checkpoint(job));
    } else {
      flip_a_bit(checkpoint(job));
    }
    const std::string log = end_job(job);
    EXPECT_THAT(log,
                ::testing::AnyOf(HasSubstr(job + ": checkpoint is damaged"), HasSubstr(job + ": checkpoint is empty")));
    EXPECT_THAT(log, HasSubstr(job + " resumes at step"));
  }
  std::cout << count << " damaged checkpoints, each time gone on from the previous one with the same bits\n";
}

TEST_F(DamagedCheckpointTest, BothDamagedTheJobBeginsAnew) {
  const int count = rounds(1, 10);
  for (int i = 0; i < count; ++i) {
    const std::string job = leave_a_job();
    tear(checkpoint(job));
    flip_a_bit(checkpoint(job, "checkpoint.previous"));
    const std::string log = end_job(job);
    EXPECT_THAT(log, HasSubstr(job + ": checkpoint.previous is damaged"));
    EXPECT_THAT(log, Not(HasSubstr(job + " resumes at step")));
  }
  std::cout << count << " times both checkpoints damaged, each time begun again with the same bits\n";
}

}  // namespace
}  // namespace cellcrush::testing

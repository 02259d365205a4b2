// What becomes of a job whose worker is lost, left or stopped, and of its bits.
#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <iostream>
#include <thread>

#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/job_numbers.h"
#include "server/small_case.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;
using Clock = std::chrono::steady_clock;

class LostWorkerTest : public DaemonFixture {
 protected:
  void SetUp() override { start(often_checkpointed()); }

  [[nodiscard]] DaemonOptions often_checkpointed() const {
    auto options = default_options();
    options.checkpoint_interval = std::chrono::milliseconds(50);
    return options;
  }

  // Cancels a job whose worker stands still and heeds no wish.
  struct Unheeded {
    std::string job;
    pid_t worker;
  };
  static Unheeded cancel_in_vain(Client& client) {
    const std::string job = create_with_samples(client, endless_case(), 5);
    const pid_t worker = client.worker_of(job);
    EXPECT_EQ(kill(worker, SIGSTOP), 0);
    EXPECT_TRUE(client.cancel(job).ok());
    return {job, worker};
  }

  // Sends the signal to each worker that the job gets, until it is given up.
  static v1::Job kill_until_it_fails(Client& client, const std::string& job, int signal) {
    pid_t last = 0;
    v1::Job now;
    EXPECT_TRUE(wait_until(
        [&] {
          now = client.get(job);
          if (now.state() == v1::Job::RUNNING && now.worker_pid() > 0 && now.worker_pid() != last) {
            last = static_cast<pid_t>(now.worker_pid());
            kill(last, signal);
          }
          return now.state() == v1::Job::FAILED;
        },
        std::chrono::seconds(30)));
    EXPECT_EQ(now.cause(), v1::Job::WORKER_CRASHED);
    return now;
  }

  [[nodiscard]] std::filesystem::path file_of(const std::string& job, const char* name) const {
    return data_folder() / job / name;
  }

  JobNumbers numbers_of(Client& client, const std::string& job) {
    return testing::numbers_of(client, data_folder(), job);
  }

  // A run that nothing disturbs; its numbers.
  JobNumbers undisturbed(Client& client) {
    const std::string whole = client.create(case_of_seconds());
    EXPECT_TRUE(client.watch(whole).status.ok());
    return numbers_of(client, whole);
  }
};

TEST_F(LostWorkerTest, ASuspendedJobHoldsStillOverARestartAndHasTheSameBitsWhenItIsResumed) {
  auto client = this->client();
  const auto whole = undisturbed(client);
  const std::string job = create_with_samples(client, case_of_seconds(), 20);
  const pid_t worker = client.worker_of(job);
  ASSERT_TRUE(client.suspend(job).ok());
  EXPECT_EQ(client.get(job).state(), v1::Job::SUSPENDED);
  EXPECT_FALSE(is_alive(worker));
  const auto samples = client.history(job).size();
  ASSERT_TRUE(client.suspend(job).ok()) << "Twice is once.";

  start(often_checkpointed());
  auto next = this->client();
  EXPECT_EQ(next.get(job).state(), v1::Job::SUSPENDED);
  EXPECT_EQ(next.history(job).size(), samples);
  ASSERT_TRUE(next.resume(job).ok());
  expect_success(next, job);
  EXPECT_EQ(next.get(job).attempt(), 2);
  EXPECT_TRUE(numbers_of(next, job) == whole);
  EXPECT_TRUE(watch_soundly(next, job).ok());
  EXPECT_EQ(next.suspend(job).error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_EQ(next.resume(job).error_code(), grpc::StatusCode::FAILED_PRECONDITION);
}

TEST_F(LostWorkerTest, AWaitingJobIsSuspendedAtOnceAndCanBeResumedOrCancelled) {
  start(with_workers(1));
  auto client = this->client();
  const std::string first = client.create(endless_case());
  const std::string second = client.create(small_case());
  const std::string third = client.create(small_case());
  for (const auto& job : {second, third}) {
    ASSERT_TRUE(client.suspend(job).ok());
    EXPECT_EQ(client.get(job).state(), v1::Job::SUSPENDED);
  }
  ASSERT_TRUE(client.cancel(first).ok());
  ASSERT_TRUE(client.wait_for_state(first, v1::Job::CANCELLED));
  ASSERT_TRUE(client.cancel(third).ok());
  EXPECT_EQ(client.get(third).state(), v1::Job::CANCELLED);
  EXPECT_EQ(client.get(second).state(), v1::Job::SUSPENDED);
  ASSERT_TRUE(client.resume(second).ok());
  ASSERT_TRUE(client.resume(second).ok()) << "Twice is once.";
  expect_success(client, second);
}

TEST_F(LostWorkerTest, ACancelThatItsWorkerNeverHeedsKeepsWhatWasComputed) {
  auto client = this->client();
  const auto [job, worker] = cancel_in_vain(client);
  EXPECT_EQ(client.get(job).state(), v1::Job::CANCELLING);
  ASSERT_TRUE(client.wait_for_state(job, v1::Job::CANCELLED));
  EXPECT_FALSE(is_alive(worker));
  EXPECT_FALSE(std::filesystem::exists(file_of(job, "result.h5.partial")));
  ASSERT_TRUE(client.get(job).has_summary()) << client.get(job).cause_message();
  const auto samples = client.history(job);
  ASSERT_GE(samples.size(), 5U);
  EXPECT_EQ(client.get(job).summary().step_count(), samples.back().step());
  EXPECT_EQ(numbers_of(client, job).history.size(), samples.size());
  EXPECT_TRUE(watch_soundly(client, job).ok());
}

TEST_F(LostWorkerTest, ACancelThatTheDaemonsEndCutsOffIsEndedByTheNextOneWithItsResult) {
  auto client = this->client();
  const auto [job, worker] = cancel_in_vain(client);
  daemon_->stop();
  EXPECT_FALSE(is_alive(worker));
  start(often_checkpointed());
  auto next = this->client();
  ASSERT_TRUE(next.wait_for_state(job, v1::Job::CANCELLED)) << v1::Job::State_Name(next.get(job).state());
  EXPECT_TRUE(next.get(job).has_summary()) << next.get(job).cause_message();
  EXPECT_TRUE(watch_soundly(next, job).ok());
}

TEST_F(LostWorkerTest, ADaemonsEndLeavesRunningJobsAtACheckpointAndTheNextOneGoesOn) {
  auto client = this->client();
  const auto whole = undisturbed(client);
  const std::string job = create_with_samples(client, case_of_seconds(), 20);
  const pid_t worker = client.worker_of(job);
  daemon_->stop();
  EXPECT_FALSE(is_alive(worker));
  EXPECT_TRUE(std::filesystem::exists(file_of(job, "checkpoint")));
  start(often_checkpointed());
  auto next = this->client();
  expect_success(next, job);
  EXPECT_TRUE(numbers_of(next, job) == whole);
  EXPECT_TRUE(watch_soundly(next, job).ok());
}

TEST_F(LostWorkerTest, AWorkerThatStandsStillIsShownAndReplaced) {
  auto options = often_checkpointed();
  options.stall_limit = std::chrono::milliseconds(1500);
  start(options);
  auto client = this->client();
  const std::string job = create_with_samples(client, endless_case(), 5);
  const pid_t worker = client.worker_of(job);
  const auto start = Clock::now();
  ASSERT_EQ(kill(worker, SIGSTOP), 0);
  bool shown = false;
  while (client.get(job).worker_pid() == worker && Clock::now() - start < std::chrono::seconds(30)) {
    shown = shown || client.get(job).progress().stalled();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  std::cout << "replaced after " << std::chrono::duration<double>(Clock::now() - start).count() << " s\n";
  EXPECT_TRUE(shown);
  EXPECT_FALSE(is_alive(worker));
  const auto samples = client.history(job).size();
  wait_for_samples(client, job, samples + 5);
  EXPECT_GT(client.history(job).size(), samples);
  EXPECT_EQ(client.get(job).state(), v1::Job::RUNNING);
  EXPECT_FALSE(client.get(job).progress().stalled());
}

TEST_F(LostWorkerTest, AJobWhoseWorkersAreKilledAgainAndAgainAtTheSamePlaceFails) {
  auto options = often_checkpointed();
  options.checkpoint_interval = std::chrono::minutes(1);
  start(options);
  auto client = this->client();
  auto submitted = endless_case();
  submitted.mutable_output()->set_sample_count(10);
  for (const auto& [number, name] : {std::pair{SIGKILL, "SIGKILL (9)"}, std::pair{SIGSEGV, "SIGSEGV (11)"}}) {
    const std::string job = client.create(submitted);
    const auto failed = kill_until_it_fails(client, job, number);
    EXPECT_EQ(failed.attempt(), 3);
    EXPECT_THAT(failed.cause_message(), HasSubstr(name));
    EXPECT_FALSE(failed.remedy().empty());
    EXPECT_EQ(failed.worker_pid(), 0);
  }
  const std::string next = client.create(small_case());
  expect_success(client, next);
}

TEST_F(LostWorkerTest, WhatKilledWorkersReportedIsKeptAsAResultUpToTheLastSample) {
  auto options = often_checkpointed();
  options.checkpoint_interval = std::chrono::minutes(1);
  start(options);
  auto client = this->client();
  const auto full = undisturbed(client);
  // Each worker is killed as soon as it gets to where the first one was: none gets further.
  const std::string job = create_with_samples(client, case_of_seconds(), 60);
  const auto failed = kill_until_it_fails(client, job, SIGKILL);
  ASSERT_TRUE(failed.has_summary());
  const auto kept = numbers_of(client, job);
  ASSERT_GE(kept.history.size(), 60U);
  ASSERT_LT(kept.history.size(), full.history.size());
  EXPECT_EQ(kept.history.size(), client.history(job).size());
  EXPECT_TRUE(std::equal(kept.history.begin(), kept.history.end(), full.history.begin())) << "The bits are the same.";
  ASSERT_GE(kept.frames.size(), 2U);
  EXPECT_TRUE(std::equal(kept.frames.begin(), kept.frames.end(), full.frames.begin()));
  EXPECT_EQ(failed.summary().step_count(), client.history(job).back().step());
}

}  // namespace
}  // namespace cellcrush::testing

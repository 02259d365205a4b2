// What becomes of a job whose worker is lost, left or stopped, and of its bits.
#include <gmock/gmock.h>
#include <signal.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <random>
#include <thread>

#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/small_case.h"
#include "store/result_reader.h"

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

  // The worker of the job; waits for one.
  static pid_t worker_of(Client& client, const std::string& job) {
    EXPECT_TRUE(client.wait_for_state(job, v1::RUNNING));
    return static_cast<pid_t>(client.get(job).worker_pid());
  }

  static void wait_for_samples(Client& client, const std::string& job, std::size_t count) {
    for (int i = 0; i < 600 && client.history(job).size() < count; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }

  [[nodiscard]] std::filesystem::path file_of(const std::string& job, const char* name) const {
    return data_folder() / job / name;
  }

  // All numbers of a result that are no times of a clock.
  struct Numbers {
    std::vector<std::string> history;
    std::vector<std::string> frames;
    std::string summary;

    bool operator==(const Numbers&) const = default;
  };
  Numbers numbers_of(Client& client, const std::string& job) {
    Numbers out;
    const store::ResultReader result(file_of(job, "result.h5"));
    for (const auto& sample : result.history()) out.history.push_back(sample.SerializeAsString());
    const int frames = static_cast<int>(result.frame_times().size());
    for (int i = 0; i < frames; ++i) out.frames.push_back(result.frame(i).SerializeAsString());
    auto summary = client.get(job).summary();
    summary.clear_solver_seconds();
    summary.clear_stage_times();
    out.summary = summary.SerializeAsString();
    return out;
  }

  // That a watch from the beginning has every event once and in order.
  static void expect_sound_events(Client& client, const std::string& job) {
    const auto watched = client.watch(job);
    EXPECT_TRUE(watched.status.ok()) << watched.status.error_message();
    std::int64_t sequence = 0;
    std::int64_t step = -1;
    for (const auto& event : watched.events) {
      if (!event.has_state() && !event.has_sample()) continue;
      EXPECT_EQ(event.sequence(), ++sequence);
      if (!event.has_sample()) continue;
      EXPECT_GT(event.sample().step(), step);
      step = event.sample().step();
    }
  }
};

TEST_F(LostWorkerTest, AJobWhoseWorkersAreKilledAtRandomMomentsHasTheSameBits) {
  auto client = this->client();
  const std::string whole = client.create(case_of_seconds());
  ASSERT_TRUE(client.watch(whole).status.ok());
  const auto expected = numbers_of(client, whole);
  ASSERT_GT(expected.history.size(), 100U);

  const std::string job = client.create(case_of_seconds());
  std::mt19937 random(7);
  int kills = 0;
  for (; kills < 8; ++kills) {
    const auto newest = client.history(job).size();
    wait_for_samples(client, job, newest + 5);
    std::this_thread::sleep_for(std::chrono::milliseconds(random() % 150));
    const auto now = client.get(job);
    if (now.state() == v1::SUCCEEDED) break;
    if (now.worker_pid() > 0) kill(static_cast<pid_t>(now.worker_pid()), SIGKILL);
  }
  ASSERT_TRUE(client.watch(job).status.ok());
  const auto ended = client.get(job);
  std::cout << kills << " kills, " << ended.attempt() << " workers\n";
  ASSERT_EQ(ended.state(), v1::SUCCEEDED) << ended.cause_message();
  EXPECT_GE(ended.attempt(), 3);
  EXPECT_TRUE(numbers_of(client, job) == expected);
  EXPECT_EQ(client.history(job).size(), expected.history.size());
  expect_sound_events(client, job);
  for (int i = 0; i < 200 && std::filesystem::exists(file_of(job, "reports")); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  EXPECT_FALSE(std::filesystem::exists(file_of(job, "reports"))) << "Soon nothing but the result is left.";
  EXPECT_FALSE(std::filesystem::exists(file_of(job, "checkpoint")));
}

TEST_F(LostWorkerTest, ASuspendedJobHoldsStillOverARestartAndHasTheSameBitsWhenItIsResumed) {
  auto client = this->client();
  const std::string whole = client.create(case_of_seconds());
  ASSERT_TRUE(client.watch(whole).status.ok());

  const std::string job = client.create(case_of_seconds());
  wait_for_samples(client, job, 20);
  const pid_t worker = worker_of(client, job);
  ASSERT_TRUE(client.suspend(job).ok());
  EXPECT_EQ(client.get(job).state(), v1::SUSPENDED);
  EXPECT_FALSE(is_alive(worker));
  const auto samples = client.history(job).size();
  ASSERT_TRUE(client.suspend(job).ok()) << "Twice is once.";

  start(often_checkpointed());
  auto next = this->client();
  EXPECT_EQ(next.get(job).state(), v1::SUSPENDED);
  EXPECT_EQ(next.history(job).size(), samples);
  ASSERT_TRUE(next.resume(job).ok());
  ASSERT_TRUE(next.watch(job).status.ok());
  EXPECT_EQ(next.get(job).state(), v1::SUCCEEDED) << next.get(job).cause_message();
  EXPECT_EQ(next.get(job).attempt(), 2);
  EXPECT_TRUE(numbers_of(next, job) == numbers_of(next, whole));
  expect_sound_events(next, job);
  EXPECT_EQ(next.suspend(job).error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_EQ(next.resume(job).error_code(), grpc::StatusCode::FAILED_PRECONDITION);
}

TEST_F(LostWorkerTest, AWaitingJobIsSuspendedAtOnceAndCanBeResumedOrCancelled) {
  auto options = often_checkpointed();
  options.workers = 1;
  start(options);
  auto client = this->client();
  const std::string first = client.create(endless_case());
  const std::string second = client.create(small_case());
  const std::string third = client.create(small_case());
  for (const auto& job : {second, third}) {
    ASSERT_TRUE(client.suspend(job).ok());
    EXPECT_EQ(client.get(job).state(), v1::SUSPENDED);
  }
  ASSERT_TRUE(client.cancel(first).ok());
  ASSERT_TRUE(client.wait_for_state(first, v1::CANCELLED));
  ASSERT_TRUE(client.cancel(third).ok());
  EXPECT_EQ(client.get(third).state(), v1::CANCELLED);
  EXPECT_EQ(client.get(second).state(), v1::SUSPENDED);
  ASSERT_TRUE(client.resume(second).ok());
  ASSERT_TRUE(client.resume(second).ok()) << "Twice is once.";
  ASSERT_TRUE(client.watch(second).status.ok());
  EXPECT_EQ(client.get(second).state(), v1::SUCCEEDED);
}

TEST_F(LostWorkerTest, ADaemonsEndLeavesRunningJobsAtACheckpointAndTheNextOneGoesOn) {
  auto client = this->client();
  const std::string whole = client.create(case_of_seconds());
  ASSERT_TRUE(client.watch(whole).status.ok());
  const std::string job = client.create(case_of_seconds());
  wait_for_samples(client, job, 20);
  const pid_t worker = worker_of(client, job);
  daemon_->stop();
  EXPECT_FALSE(is_alive(worker));
  EXPECT_TRUE(std::filesystem::exists(file_of(job, "checkpoint")));
  start(often_checkpointed());
  auto next = this->client();
  ASSERT_TRUE(next.watch(job).status.ok());
  EXPECT_EQ(next.get(job).state(), v1::SUCCEEDED) << next.get(job).cause_message();
  EXPECT_TRUE(numbers_of(next, job) == numbers_of(next, whole));
  expect_sound_events(next, job);
}

TEST_F(LostWorkerTest, AWorkerThatStandsStillIsShownAndReplaced) {
  auto options = often_checkpointed();
  options.stall_limit = std::chrono::milliseconds(1500);
  start(options);
  auto client = this->client();
  const std::string job = client.create(endless_case());
  wait_for_samples(client, job, 5);
  const pid_t worker = worker_of(client, job);
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
  EXPECT_EQ(client.get(job).state(), v1::RUNNING);
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
    pid_t last = 0;
    for (int i = 0; i < 600 && client.get(job).state() != v1::FAILED; ++i) {
      const auto now = client.get(job);
      if (now.worker_pid() != last && now.worker_pid() > 0) {
        last = static_cast<pid_t>(now.worker_pid());
        kill(last, number);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    const auto failed = client.get(job);
    EXPECT_EQ(failed.state(), v1::FAILED);
    EXPECT_EQ(failed.cause(), v1::WORKER_CRASHED);
    EXPECT_EQ(failed.attempt(), 3);
    EXPECT_THAT(failed.cause_message(), HasSubstr(name));
    EXPECT_FALSE(failed.remedy().empty());
    EXPECT_EQ(failed.worker_pid(), 0);
  }
  const std::string next = client.create(small_case());
  ASSERT_TRUE(client.watch(next).status.ok());
  EXPECT_EQ(client.get(next).state(), v1::SUCCEEDED) << "The daemon goes on.";
}

}  // namespace
}  // namespace cellcrush::testing

// What the daemon does not take, when a job takes too long, and what it does when the disk is nearly full.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <optional>

#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/job_numbers.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;
using Clock = std::chrono::steady_clock;

// Tests that fill the disk do so one after another, whatever runs them.
class DiskTurn {
 public:
  DiskTurn()
      : lock_(open((std::filesystem::temp_directory_path() / "cellcrush-tests-disk.lock").c_str(),
                   O_CREAT | O_RDWR | O_CLOEXEC, 0600)) {
    EXPECT_EQ(flock(lock_, LOCK_EX), 0);
  }
  ~DiskTurn() { close(lock_); }
  DiskTurn(const DiskTurn&) = delete;
  DiskTurn& operator=(const DiskTurn&) = delete;

 private:
  int lock_;
};

class LimitsTest : public DaemonFixture {
 protected:
  static grpc::Status try_to_create(Client& client, const v1::Case& submitted, const std::string& request_id = "") {
    auto request = job_of(submitted);
    request.set_request_id(request_id);
    return client.try_to(request);
  }

  // A daemon with one worker, which is busy, and room for so many other jobs.
  void start_busy(int queued_jobs) {
    auto options = with_workers(1);
    options.limits.queued_jobs = queued_jobs;
    start(options);
    auto client = this->client();
    ASSERT_TRUE(client.wait_for_state(client.create(endless_case()), v1::Job::RUNNING));
  }

  [[nodiscard]] std::int64_t free_bytes() const {
    return static_cast<std::int64_t>(std::filesystem::space(folder_.path()).available);
  }
};

TEST_F(LimitsTest, BeyondTheQueuesDepthNothingIsTakenAndTheRemedyIsNamed) {
  start_busy(2);
  auto client = this->client();
  client.create(small_case());
  ASSERT_TRUE(try_to_create(client, small_case(), "second").ok());
  const auto refused = try_to_create(client, small_case());
  EXPECT_THAT(refused, Fails(grpc::StatusCode::RESOURCE_EXHAUSTED, "--max-queued-jobs"));
  EXPECT_TRUE(try_to_create(client, small_case(), "second").ok()) << "What was taken before is told again.";
  EXPECT_EQ(client.try_to(sweep_of(small_case(), kSpeed, {50.0, 100.0})).error_code(),
            grpc::StatusCode::RESOURCE_EXHAUSTED);
}

TEST_F(LimitsTest, ACancelledSweepFreesItsPlacesInTheQueueAtOnce) {
  start_busy(3);
  auto client = this->client();
  for (int i = 0; i < 3; ++i) {
    const auto sweep = create(client, sweep_of(small_case(), kSpeed, {50.0, 100.0, 150.0}));
    EXPECT_EQ(count_in(cancel_sweep(client, sweep.name()), v1::Job::CANCELLED), 3);
  }
  EXPECT_TRUE(try_to_create(client, small_case()).ok());
}

TEST_F(LimitsTest, ASweepThatMaxFailuresStopsFreesItsPlacesAtOnce) {
  auto options = with_workers(1);
  options.limits.queued_jobs = 3;
  start(options);
  auto client = this->client();
  auto request = sweep_of(endless_case(), "plates.friction", {0.0, 0.1, 0.2});
  request.mutable_sweep()->set_max_failures(1);
  request.mutable_sweep()->set_time_limit_s(1.0);
  const auto sweep = create(client, request);
  ASSERT_TRUE(wait_for_count(client, sweep.name(), v1::Job::RUNNING, 1));
  // Takes the worker before the others of the sweep could leave the queue through it.
  auto urgent = job_of(endless_case());
  urgent.set_priority(100);
  const std::string next = client.create(urgent).name();
  ASSERT_TRUE(wait_for_count(client, sweep.name(), v1::Job::FAILED, 1));
  ASSERT_TRUE(client.wait_for_state(next, v1::Job::RUNNING));
  EXPECT_EQ(count_in(get_sweep(client, sweep.name()), v1::Job::CANCELLED), 2);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(try_to_create(client, small_case()).ok()) << i;
}

TEST_F(LimitsTest, ASweepWhoseLabelsWouldFillTheJournalIsRefused) {
  auto client = this->client();
  auto request = sweep_of(small_case(), "plates.friction", {});
  for (int i = 0; i < 10'000; ++i) request.mutable_sweep()->mutable_axes(0)->mutable_list()->add_values(1e-5 * i);
  for (int i = 0; i < 64; ++i)
    (*request.mutable_sweep()->mutable_labels())["key-" + std::to_string(i)] = std::string(255, 'x');
  request.set_validate_only(true);
  const auto refused = client.try_to(request);
  EXPECT_THAT(refused, Fails(grpc::StatusCode::INVALID_ARGUMENT, "sweep.labels"));
  EXPECT_THAT(refused.error_message(), HasSubstr("at most 16 MiB"));
}

TEST_F(LimitsTest, AJobThatNeedsMoreMemoryThanThereIsIsRefused) {
  auto options = default_options();
  options.limits.job_memory_bytes = 36 * 1024 * 1024;
  start(options);
  auto client = this->client();
  const auto refused = try_to_create(client, endless_case());
  EXPECT_THAT(refused, Fails(grpc::StatusCode::RESOURCE_EXHAUSTED, "elements_per_wall"));
  EXPECT_TRUE(try_to_create(client, small_case()).ok());
  EXPECT_EQ(client.try_to(sweep_of(endless_case(), kSpeed, {50.0, 100.0})).error_code(),
            grpc::StatusCode::RESOURCE_EXHAUSTED);
}

TEST_F(LimitsTest, WithTooLittleRoomOnTheDiskNothingIsTaken) {
  const DiskTurn turn;
  auto options = default_options();
  options.limits.free_disk_bytes = 2 * free_bytes();
  start(options);
  auto client = this->client();
  const auto refused = try_to_create(client, small_case());
  EXPECT_THAT(refused, Fails(grpc::StatusCode::RESOURCE_EXHAUSTED, "Free disk space"));
  EXPECT_TRUE(client.list().empty()) << "It can still be read.";
}

// The disk is that of the temporary folder; a large file takes its room and gives it back.
class FullDiskTest : public LimitsTest {
 protected:
  static constexpr std::int64_t kTaken = 512 * 1024 * 1024;

  void SetUp() override {
    turn_.emplace();
    const std::int64_t before = free_bytes();
    if (before < 2 * kTaken) GTEST_SKIP() << "The disk of the temporary folder has too little room for this test.";
    auto options = default_options();
    options.limits.free_disk_bytes = before - kTaken / 2;
    options.housekeeping_interval = std::chrono::milliseconds(50);
    start(options);
  }

  [[nodiscard]] std::filesystem::path large_file() const { return folder_.path() / "large"; }

  void take_room() const {
    const std::string command = "fallocate -l " + std::to_string(kTaken) + " " + large_file().string();
    ASSERT_EQ(std::system(command.c_str()), 0);
  }

  // Until the daemon has seen that there is too little room, at most 10 s.
  static bool wait_until_held(const Client& client) {
    return wait_until([&] { return !client.queue().holds().empty(); }, std::chrono::seconds(10));
  }

 private:
  std::optional<DiskTurn> turn_;
};

TEST_F(FullDiskTest, RunningJobsAreLeftUntilThereIsRoom) {
  auto client = this->client();
  const std::string job = client.create(endless_case(), v1::Job::RUNNING);
  ASSERT_NO_FATAL_FAILURE(take_room());
  EXPECT_TRUE(client.wait_for_state(job, v1::Job::PENDING));
  const auto queue = client.queue();
  ASSERT_EQ(queue.entries_size(), 1);
  EXPECT_THAT(queue.entries(0).reason(), HasSubstr("nearly full"));
  EXPECT_EQ(try_to_create(client, small_case()).error_code(), grpc::StatusCode::RESOURCE_EXHAUSTED);
  std::filesystem::remove(large_file());
  EXPECT_TRUE(client.wait_for_state(job, v1::Job::RUNNING));
  EXPECT_EQ(client.get(job).attempt(), 2);
  ASSERT_TRUE(client.cancel(job).ok());
}

TEST_F(FullDiskTest, AJobThatIsCancelledEndsBeforeThereIsRoom) {
  auto client = this->client();
  const std::string job = create_with_samples(client, endless_case(), 5);
  const pid_t worker = client.worker_of(job);
  ASSERT_EQ(kill(worker, SIGSTOP), 0) << "It heeds no wish.";
  ASSERT_NO_FATAL_FAILURE(take_room());
  ASSERT_TRUE(wait_until_held(client));
  ASSERT_TRUE(client.cancel(job).ok());
  EXPECT_TRUE(client.wait_for_state(job, v1::Job::CANCELLED)) << v1::Job::State_Name(client.get(job).state());
  EXPECT_TRUE(client.get(job).has_summary()) << client.get(job).cause_message();
}

TEST_F(LimitsTest, WhileItDrainsNewJobsAreRefusedAndOldOnesServed) {
  auto client = this->client();
  const std::string job = client.create(small_case());
  answer_of(*v1::Admin::NewStub(client.channel), &v1::Admin::Stub::Drain, {});
  const auto refused = try_to_create(client, small_case());
  EXPECT_THAT(refused, Fails(grpc::StatusCode::UNAVAILABLE, "shutting down"));
  EXPECT_TRUE(client.watch(job).status.ok());
}

class TimeLimitTest : public DaemonFixture {
 protected:
  static v1::CreateJobRequest limited(double seconds) {
    auto request = job_of(endless_case());
    request.set_time_limit_s(seconds);
    return request;
  }

  static std::string create_limited(Client& client, double seconds) {
    const auto job = client.create(limited(seconds));
    EXPECT_EQ(job.time_limit_s(), seconds);
    return job.name();
  }

  // That the job ended at its limit, with a result up to there.
  void expect_out_of_time(Client& client, const std::string& name) {
    ASSERT_TRUE(client.wait_for_state(name, v1::Job::FAILED));
    const auto job = client.get(name);
    EXPECT_EQ(job.cause(), v1::Job::TIME_LIMIT);
    EXPECT_THAT(job.cause_message(), HasSubstr("its time limit of"));
    EXPECT_THAT(job.remedy(), HasSubstr("time_limit_s"));
    ASSERT_TRUE(job.has_summary());
    const auto numbers = numbers_of(client, data_folder(), name);
    EXPECT_EQ(numbers.history.size(), client.history(name).size());
    EXPECT_EQ(client.history(name).back().step(), job.summary().step_count());
  }
};

TEST_F(TimeLimitTest, AtItsLimitAJobEndsWithWhatThereIs) {
  auto client = this->client();
  const auto start = Clock::now();
  expect_out_of_time(client, create_limited(client, 1.0));
  EXPECT_GE(Clock::now() - start, std::chrono::seconds(1));
}

TEST_F(TimeLimitTest, APauseDoesNotCountAndWhatWasRunBeforeDoes) {
  auto client = this->client();
  const std::string job = create_limited(client, 2.0);
  wait_for_samples(client, job, 200);
  ASSERT_TRUE(client.suspend(job).ok());
  const auto left_at = client.history(job).size();
  start();
  auto next = this->client();
  ASSERT_TRUE(next.resume(job).ok());
  expect_out_of_time(next, job);
  EXPECT_GT(next.history(job).size(), left_at);
  const auto ended = next.get(job);
  EXPECT_LT(ended.summary().solver_seconds(), 2.3) << "The time before the pause counts.";
}

TEST_F(TimeLimitTest, TheDaemonsLimitHoldsForThoseWithoutOneAndMoreIsRefused) {
  auto options = default_options();
  options.limits.job_time = std::chrono::duration<double>(1.0);
  start(options);
  auto client = this->client();
  const std::string limited_by_daemon = create_limited(client, 0.0);
  ASSERT_TRUE(client.wait_for_state(limited_by_daemon, v1::Job::FAILED));
  EXPECT_THAT(client.get(limited_by_daemon).cause_message(), HasSubstr("its time limit of"));
  EXPECT_THAT(client.get(limited_by_daemon).remedy(),
              ::testing::AllOf(HasSubstr("Start the daemon with --max-job-time"), HasSubstr("--time-limit")));
  const auto refused = client.try_to(limited(2.0));
  EXPECT_THAT(refused, Fails(grpc::StatusCode::INVALID_ARGUMENT, "time_limit_s"));
  EXPECT_THAT(refused.error_message(), HasSubstr("--max-job-time"));
}

TEST_F(TimeLimitTest, WhatIsNoTimeIsRefused) {
  auto client = this->client();
  for (const double seconds : {-1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(client.try_to(limited(seconds)).error_code(), grpc::StatusCode::INVALID_ARGUMENT) << seconds;
}

TEST_F(TimeLimitTest, ASweepsJobsAndThoseTriedAgainHaveItsLimit) {
  auto client = this->client();
  auto request = sweep_of(endless_case(), kSpeed, {50.0});
  request.mutable_sweep()->set_time_limit_s(0.5);
  const auto sweep = create(client, request);
  ASSERT_EQ(sweep.jobs_size(), 1);
  expect_out_of_time(client, sweep.jobs(0));
  const auto again = retry(client, sweep.name());
  ASSERT_EQ(again.jobs_size(), 1);
  EXPECT_NE(again.jobs(0), sweep.jobs(0));
  expect_out_of_time(client, again.jobs(0));
}

}  // namespace
}  // namespace cellcrush::testing

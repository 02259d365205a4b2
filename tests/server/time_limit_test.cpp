// A job that takes longer than it may.
#include <gmock/gmock.h>

#include <chrono>
#include <limits>

#include "server/daemon_fixture.h"
#include "server/job_numbers.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;
using Clock = std::chrono::steady_clock;

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
  EXPECT_THAT(client.get(limited_by_daemon).cause_message(), HasSubstr("the daemon's time limit of"));
  EXPECT_THAT(client.get(limited_by_daemon).remedy(), HasSubstr("--max-job-time"));
  const auto refused = client.try_to(limited(2.0));
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(refused.error_message(), HasSubstr("time_limit_s"));
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

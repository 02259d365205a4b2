#include <gmock/gmock.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "server/daemon_process.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"

namespace cellcrush::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class SweepFailuresTest : public DaemonFixture {
 protected:
  void SetUp() override { start_with(CELLCRUSHD_PROGRAM); }

  // One worker, run by that program.
  void start_with(const std::filesystem::path& program) {
    auto options = with_workers(1);
    options.worker_program = program;
    start(options);
  }

  static v1::CreateSweepRequest six_points(int max_failures) {
    // All take equally long, so that they start in their order.
    auto out = sweep_of(small_case(), "plates.friction", {0.0, 0.1, 0.2, 0.3, 0.4, 0.5});
    out.mutable_sweep()->set_max_failures(max_failures);
    return out;
  }

  // Kills the job's workers as they come, so that it FAILED.
  static void crash(Client& client, const std::string& job) {
    ASSERT_TRUE(client.wait_for_state(job, v1::Job::RUNNING));
    for (int i = 0; i < 1000; ++i) {
      const auto now = client.get(job);
      if (now.state() == v1::Job::FAILED) return;
      if (now.worker_pid() > 0) kill(static_cast<pid_t>(now.worker_pid()), SIGKILL);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    FAIL() << job << " is tried again and again.";
  }
};

TEST_F(SweepFailuresTest, AfterMaxFailuresTheJobsThatWaitAreCancelledAndSayWhy) {
  start_with("/bin/false");
  auto client = this->client();
  const auto sweep = create(client, six_points(2));
  EXPECT_EQ(sweep.max_failures(), 2);
  EXPECT_TRUE(watch_sweep(client, sweep.name()).status.ok()) << "A watch ends with the jobs that were not started.";
  const auto after = get_sweep(client, sweep.name());
  EXPECT_EQ(count_in(after, v1::Job::FAILED), 2);
  EXPECT_EQ(client.get(sweep.jobs(0)).cause(), v1::Job::WORKER_CRASHED);
  EXPECT_THAT(client.get(sweep.jobs(0)).cause_message(), HasSubstr("exited with code 1"));
  EXPECT_EQ(count_in(after, v1::Job::CANCELLED), 4);
  const auto stopped = client.get(sweep.jobs(5));
  EXPECT_EQ(stopped.state(), v1::Job::CANCELLED);
  EXPECT_THAT(stopped.cause_message(), HasSubstr("2 jobs of sweeps/1 failed, reaching its max_failures of 2"));
  EXPECT_THAT(stopped.remedy(), HasSubstr("cellcrush retry sweeps/1"));
  EXPECT_EQ(stopped.cause(), v1::Job::JOB_CAUSE_UNSPECIFIED);
}

TEST_F(SweepFailuresTest, WithoutMaxFailuresEveryJobIsTriedAndOtherJobsAreNotTouched) {
  start_with("/bin/false");
  auto client = this->client();
  const auto unlimited = create(client, six_points(0));
  ASSERT_TRUE(wait_for_count(client, unlimited.name(), v1::Job::FAILED, 6));
  const auto limited = create(client, six_points(1));
  const std::string other = client.create(small_case(), v1::Job::FAILED);
  EXPECT_EQ(count_in(get_sweep(client, limited.name()), v1::Job::CANCELLED), 5);
}

TEST_F(SweepFailuresTest, FailuresBeforeADaemonsEndCountAfterIt) {
  std::string name;
  {
    auto client = this->client();
    auto request = six_points(2);
    *request.mutable_sweep()->mutable_case_() = endless_case();
    const auto sweep = create(client, request);
    name = sweep.name();
    crash(client, sweep.jobs(0));
    ASSERT_TRUE(client.wait_for_state(sweep.jobs(1), v1::Job::RUNNING));
    EXPECT_EQ(count_in(get_sweep(client, name), v1::Job::PENDING), 4);
  }
  daemon_->stop();
  start_with("/bin/false");
  auto client = this->client();
  EXPECT_TRUE(watch_sweep(client, name).status.ok());
  const auto after = get_sweep(client, name);
  EXPECT_EQ(count_in(after, v1::Job::FAILED), 2) << "One before and one after.";
  EXPECT_EQ(count_in(after, v1::Job::CANCELLED), 4);
}

TEST_F(SweepFailuresTest, RetryQueuesWhatFailedAndWhatWasStoppedAndNothingElse) {
  auto client = this->client();
  auto request = six_points(1);
  (*request.mutable_sweep()->mutable_labels())["batch"] = "a";
  request.mutable_sweep()->set_priority(3);
  request.mutable_sweep()->set_max_failures(1);
  *request.mutable_sweep()->mutable_case_() = endless_case();
  // The first of those that take longest is the second point, as the first has fewer steps.
  request.mutable_sweep()->clear_axes();
  for (const double strain : {0.0001, 0.5, 0.49, 0.48}) {
    auto& fields = *request.mutable_sweep()->add_points()->mutable_fields();
    fields["loading.end_strain"] = strain;
    fields["loading.speed_m_per_s"] = strain < 0.1 ? 100.0 : 1.0;
  }
  const auto sweep = create(client, request);
  ASSERT_TRUE(client.wait_for_state(sweep.jobs(1), v1::Job::RUNNING));
  ASSERT_TRUE(client.cancel(sweep.jobs(2)).ok());
  crash(client, sweep.jobs(1));
  ASSERT_TRUE(client.wait_for_state(sweep.jobs(0), v1::Job::CANCELLED));

  const auto retried = retry(client, sweep.name());
  EXPECT_THAT(retried.jobs(), ElementsAre("jobs/5", "jobs/6", sweep.jobs(2), "jobs/7"));
  EXPECT_EQ(client.get(sweep.jobs(2)).cause_message(), "") << "What its owner cancelled stays so.";
  const auto again = client.get("jobs/6");
  EXPECT_EQ(again.retry_of(), sweep.jobs(1));
  EXPECT_EQ(again.labels().at("batch"), "a");
  EXPECT_EQ(again.priority(), 3);
  EXPECT_EQ(again.case_().SerializeAsString(), client.get(sweep.jobs(1)).case_().SerializeAsString());
  EXPECT_EQ(client.get(sweep.jobs(1)).state(), v1::Job::FAILED) << "The old job stays as it was.";
  EXPECT_TRUE(client.get(sweep.jobs(1)).retry_of().empty());
  const auto table = table_of(client, sweep.name());
  ASSERT_EQ(table.rows_size(), 4);
  EXPECT_EQ(table.rows(1).job(), "jobs/6");
  EXPECT_THAT(table.rows(1).values(), ElementsAre(0.5, 1.0)) << "The point is the same.";

  EXPECT_THAT(retry(client, sweep.name()).jobs(), ElementsAre("jobs/5", "jobs/6", sweep.jobs(2), "jobs/7"))
      << "A second call finds none.";
  ASSERT_TRUE(client.wait_for_state("jobs/6", v1::Job::RUNNING)) << "The longest comes first again.";
}

TEST_F(SweepFailuresTest, AStoppedSweepIsRetriedToItsEndByTheNextDaemon) {
  start_with("/bin/false");
  std::string name;
  {
    auto client = this->client();
    name = create(client, six_points(2)).name();
    ASSERT_TRUE(wait_for_count(client, name, v1::Job::CANCELLED, 4));
  }
  daemon_->stop();
  start_with(CELLCRUSHD_PROGRAM);
  auto client = this->client();
  retry(client, name);
  ASSERT_TRUE(wait_for_count(client, name, v1::Job::SUCCEEDED, 6));
  const auto watched = watch_sweep(client, name);
  EXPECT_TRUE(watched.status.ok()) << watched.status.error_message();
  EXPECT_EQ(watched.responses.front().snapshot().jobs(0), "jobs/7") << "A new watch sees the new jobs.";
}

TEST_F(SweepFailuresTest, AWatchFromBeforeTheRetryEndsWithTheOldJobs) {
  auto client = this->client();
  const auto sweep = create(client, sweep_of(endless_case(), kSpeed, {1.0, 2.0}));
  crash(client, sweep.jobs(0));
  ASSERT_TRUE(client.wait_for_state(sweep.jobs(1), v1::Job::RUNNING));
  const auto before = watch_sweep(client, sweep.name(), "", 3);
  const auto retried = retry(client, sweep.name());
  EXPECT_THAT(retried.jobs(), ElementsAre("jobs/3", sweep.jobs(1)));
  ASSERT_TRUE(client.cancel(sweep.jobs(1)).ok());
  ASSERT_TRUE(client.wait_for_state("jobs/3", v1::Job::RUNNING));
  ASSERT_TRUE(client.cancel("jobs/3").ok());
  // Its token names a job that the sweep has no more.
  const auto after = watch_sweep(client, sweep.name(), before.responses.back().resume_token());
  EXPECT_TRUE(after.status.ok()) << after.status.error_message();
  EXPECT_THAT(after.responses.front().snapshot().jobs(), ElementsAre("jobs/3", sweep.jobs(1)));
}

TEST_F(SweepFailuresTest, RetryingWhatIsNoSweepIsNotFound) {
  auto client = this->client();
  for (const char* name : {"sweeps/9", "jobs/1"})
    EXPECT_EQ(try_call(*client.sweeps, &v1::Sweeps::Stub::RetryFailedJobs, named<v1::RetryFailedJobsRequest>(name))
                  .error_code(),
              grpc::StatusCode::NOT_FOUND);
}

}  // namespace
}  // namespace cellcrush::testing

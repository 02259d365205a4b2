// Jobs of an executor that the daemon was started without.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "log_format.h"
#include "server/executors_fixture.h"
#include "server/log_capture.h"
#include "store/journal.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;

using AbsentExecutorTest = ExecutorsTest;

TEST_F(AbsentExecutorTest, JobsOfAnExecutorThatIsGoneWaitAndCanBeCancelled) {
  start(with_cluster(1));
  std::string placed;
  std::string waiting;
  {
    auto client = this->client();
    placed = create_on(client, kCluster);
    ASSERT_TRUE(wait_for_place(client, placed));
    waiting = create_on(client, kCluster);
  }
  const LogCapture log(make_text_formatter());
  restart(default_options());
  EXPECT_EQ(log.count_lines("2 unfinished jobs are for slurm/test, an executor that this daemon does not have"), 1);
  auto client = this->client();
  EXPECT_TRUE(client.wait_for_state(client.create(tiny_case()), v1::Job::SUCCEEDED)) << "Others run.";
  const auto queue = client.queue();
  ASSERT_EQ(queue.entries_size(), 2);
  for (const auto& entry : queue.entries()) {
    EXPECT_EQ(entry.executor(), kCluster);
    EXPECT_THAT(entry.reason(), HasSubstr("This daemon does not have slurm/test"));
  }
  EXPECT_TRUE(queue.holds().empty());
  EXPECT_TRUE(is_serving(client, "cellcrush.queue"));
  EXPECT_EQ(client.suspend(placed).error_code(), grpc::StatusCode::FAILED_PRECONDITION) << "Its cluster may start it.";
  EXPECT_EQ(client.get(placed).state(), v1::Job::PENDING);
  EXPECT_TRUE(client.cancel(waiting).ok());
  EXPECT_EQ(client.get(waiting).state(), v1::Job::CANCELLED);
  EXPECT_TRUE(client.remove(waiting).ok());

  cluster_.open();
  restart(with_cluster(1));
  auto again = this->client();
  EXPECT_TRUE(again.wait_for_state(placed, v1::Job::SUCCEEDED)) << again.get(placed).cause_message();
}

TEST_F(AbsentExecutorTest, AJobThatRunsOnAnExecutorThatIsGoneEndsOnceItIsCancelled) {
  const auto options = with_program(CELLCRUSHD_PROGRAM);
  start(options);
  std::string job;
  {
    auto client = this->client();
    job = create_on(client, kCluster, endless_case());
    ASSERT_TRUE(client.wait_for_state(job, v1::Job::RUNNING));
  }
  daemon_.reset();
  {
    // As a daemon leaves it that is killed.
    store::Journal journal(data_folder() / "journal.sqlite", [](std::int64_t) {});
    store::StateChange running;
    running.state = v1::Job::RUNNING;
    journal.change_state(1, running);
  }
  start(default_options());
  auto client = this->client();
  EXPECT_EQ(client.get(job).state(), v1::Job::RUNNING);
  const auto refused = client.suspend(job);
  EXPECT_THAT(refused, Fails(grpc::StatusCode::FAILED_PRECONDITION, "jobs/1 is for slurm/test"));
  EXPECT_TRUE(client.cancel(job).ok());
  EXPECT_EQ(client.get(job).state(), v1::Job::CANCELLED);
  EXPECT_THAT(client.get(job).cause_message(), HasSubstr("slurm/test"));
  EXPECT_TRUE(client.cancel(job).ok()) << "It is idempotent.";
  EXPECT_TRUE(client.remove(job).ok());
}

TEST_F(AbsentExecutorTest, ARetryStaysOnTheExecutorOfItsSweep) {
  start(with_program("/bin/false"));
  std::string name;
  {
    auto client = this->client();
    name = create_sweep_on(client, kCluster, tiny_case()).name();
    ASSERT_TRUE(wait_for_count(client, name, v1::Job::FAILED, 3));
    EXPECT_EQ(get_sweep(client, name).executor(), kCluster);
  }
  restart(default_options());
  {
    auto client = this->client();
    const auto refused =
        try_call(*client.sweeps, &v1::Sweeps::Stub::RetryFailedJobs, named<v1::RetryFailedJobsRequest>(name));
    EXPECT_THAT(refused,
                Fails(grpc::StatusCode::FAILED_PRECONDITION, "slurm/test, an executor that this daemon does not have"));
  }
  restart(with_program(CELLCRUSHD_PROGRAM));
  auto client = this->client();
  retry(client, name);
  EXPECT_TRUE(wait_for_count(client, name, v1::Job::SUCCEEDED, 3));
  const auto sweep = get_sweep(client, name);
  for (const auto& job : sweep.jobs()) EXPECT_EQ(client.get(job).executor(), kCluster);
}

TEST_F(AbsentExecutorTest, ACancelledSweepDoesNotRunWhenItsClusterComesToIt) {
  start(with_cluster(3));
  std::string sweep;
  {
    auto client = this->client();
    sweep = create_sweep_on(client, kCluster, tiny_case()).name();
    ASSERT_TRUE(wait_until([&] { return cluster_.queued() == 3; }));
  }
  restart(default_options());
  {
    auto client = this->client();
    for (int i = 1; i <= 3; ++i) std::ofstream(data_folder() / "jobs" / std::to_string(i) / "order") << "an order";
    EXPECT_EQ(count_in(cancel_sweep(client, sweep), v1::Job::CANCELLED), 3);
  }
  for (int i = 1; i <= 3; ++i)
    EXPECT_FALSE(std::filesystem::exists(data_folder() / "jobs" / std::to_string(i) / "order"))
        << "A worker would run.";
}

}  // namespace
}  // namespace cellcrush::testing

// Several executors in one daemon: what is chosen, what one cannot do to another, and what a cluster's queue holds.
#include <gmock/gmock.h>

#include <thread>

#include "cellcrush/v1/admin_service.grpc.pb.h"
#include "error.h"
#include "log_format.h"
#include "server/daemon_fixture.h"
#include "server/log_capture.h"
#include "server/raw_call.h"
#include "server/small_case.h"
#include "server/small_cluster.h"
#include "server/sweep_requests.h"

namespace cellcrush::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr const char* kCluster = "slurm/test";

class ExecutorsTest : public DaemonFixture {
 protected:
  void SetUp() override {}

  [[nodiscard]] DaemonOptions with_cluster(int slots = 2) {
    auto options = default_options();
    options.executors.push_back(cluster_.executor(kCluster, slots));
    options.hold_times = {std::chrono::milliseconds(20), std::chrono::milliseconds(200)};
    return options;
  }

  // A second executor of workers on this machine, from that program.
  [[nodiscard]] DaemonOptions with_program(const std::filesystem::path& program) const {
    auto options = default_options();
    options.hold_times = {std::chrono::milliseconds(20), std::chrono::milliseconds(200)};
    options.executors.push_back({kCluster, 2, [program](const jobs::ExecutorSurroundings& given) {
                                   return std::make_unique<jobs::LocalProcess>(program, given.stall_limit);
                                 }});
    return options;
  }

  void restart(const DaemonOptions& options) {
    daemon_.reset();
    start(options);
  }

  static grpc::Status try_create(Client& client, const std::string& executor, v1::Job& out,
                                 const v1::Case& submitted = tiny_case()) {
    v1::CreateJobRequest request;
    *request.mutable_case_() = submitted;
    request.set_executor(executor);
    return client.jobs->CreateJob(bounded_context().get(), request, &out);
  }

  static std::string create_on(Client& client, const std::string& executor, const v1::Case& submitted = tiny_case()) {
    v1::Job out;
    const auto status = try_create(client, executor, out, submitted);
    EXPECT_TRUE(status.ok()) << status.error_message();
    return out.name();
  }

  static v1::Sweep create_sweep_on(Client& client, const std::string& executor, const v1::Case& submitted) {
    auto request = sweep_of(submitted, "plates.friction", {0.0, 0.1, 0.2});
    request.mutable_sweep()->set_executor(executor);
    return create(client, request);
  }

  static v1::Queue queue_of(const Client& client) {
    v1::Queue out;
    const auto status = v1::Admin::NewStub(client.channel)->GetQueue(bounded_context().get(), {}, &out);
    EXPECT_TRUE(status.ok()) << status.error_message();
    return out;
  }

  // Waits for something at most 20 s.
  template <class Condition>
  static bool wait_until(const Condition& condition) {
    for (int i = 0; i < 2000; ++i) {
      if (condition()) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }

  bool wait_for_place(Client& client, const std::string& job) {
    return wait_until([&] { return !client.get(job).place().empty(); });
  }

  SmallCluster cluster_;
};

TEST_F(ExecutorsTest, AJobRunsOnTheExecutorThatItNamesAndSaysSo) {
  cluster_.open();
  start(with_cluster());
  auto client = this->client();
  const std::string here = client.create(tiny_case());
  const std::string there = create_on(client, kCluster);
  EXPECT_TRUE(client.wait_for_state(here, v1::Job::SUCCEEDED));
  EXPECT_TRUE(client.wait_for_state(there, v1::Job::SUCCEEDED)) << client.get(there).cause_message();
  EXPECT_EQ(client.get(here).executor(), "local");
  EXPECT_EQ(client.get(there).executor(), kCluster);
  EXPECT_EQ(cluster_.threads().size(), 1U) << "The other job was not handed to it.";
  for (const auto& event : client.watch(there).events) {
    if (!event.has_state()) continue;
    EXPECT_EQ(event.state().executor(), kCluster);
  }
}

TEST_F(ExecutorsTest, ARequestWithoutOneGetsTheDefault) {
  cluster_.open();
  auto options = with_cluster(3);
  options.default_executor = kCluster;
  start(options);
  auto client = this->client();
  EXPECT_EQ(client.get(client.create(tiny_case())).executor(), kCluster);
  EXPECT_EQ(client.get(create_on(client, "local")).executor(), "local");
  v1::Capabilities capabilities;
  EXPECT_TRUE(v1::Admin::NewStub(client.channel)->GetCapabilities(bounded_context().get(), {}, &capabilities).ok());
  EXPECT_EQ(capabilities.default_executor(), kCluster);
  ASSERT_EQ(capabilities.executors_size(), 2);
  EXPECT_EQ(capabilities.executors(0).name(), "local");
  EXPECT_EQ(capabilities.executors(0).job_limit(), 2);
  EXPECT_EQ(capabilities.executors(1).name(), kCluster);
  EXPECT_EQ(capabilities.executors(1).job_limit(), 3);
  EXPECT_EQ(capabilities.worker_limit(), 2);
}

TEST_F(ExecutorsTest, ADefaultThatTheDaemonLacksIsRefused) {
  auto options = with_cluster();
  options.default_executor = "slurm/other";
  try {
    start(options);
    FAIL() << "It started.";
  } catch (const ServiceError& error) {
    EXPECT_EQ(error.kind(), ServiceError::Kind::invalid);
    EXPECT_THAT(error.what(), AllOf(HasSubstr("--executor is \"slurm/other\""), HasSubstr("local, slurm/test")));
  }
}

TEST_F(ExecutorsTest, AnUnknownOneIsRefusedWithThoseThereAre) {
  start(with_cluster());
  auto client = this->client();
  v1::Job job;
  const auto refused = try_create(client, "slurm/other", job);
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(refused.error_message(),
              AllOf(HasSubstr("executor is \"slurm/other\""), HasSubstr("local, slurm/test"), HasSubstr("leave it")));
  EXPECT_EQ(try_create(client, std::string(200, 'x'), job).error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  auto request = sweep_of(tiny_case(), "plates.friction", {0.0, 0.1});
  request.mutable_sweep()->set_executor("slurm/other");
  v1::Sweep sweep;
  const auto refused_sweep = client.sweeps->CreateSweep(bounded_context().get(), request, &sweep);
  EXPECT_EQ(refused_sweep.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(refused_sweep.error_message(), HasSubstr("sweep.executor is \"slurm/other\""));
}

TEST_F(ExecutorsTest, TroubleOfOneHoldsItsOwnQueueOnly) {
  const LogCapture log(make_text_formatter());
  const auto program = folder_.path() / "program";
  start(with_program(program));
  auto client = this->client();
  const std::string there = create_on(client, kCluster);
  ASSERT_TRUE(wait_until([&] { return queue_of(client).holds_size() == 1; }));
  const auto queue = queue_of(client);
  EXPECT_EQ(queue.holds(0).executor(), kCluster);
  EXPECT_EQ(queue.holds(0).cause(), "worker");
  ASSERT_EQ(queue.entries_size(), 1);
  EXPECT_EQ(queue.entries(0).executor(), kCluster);
  EXPECT_FALSE(is_serving(client.channel, "cellcrush.queue"));
  EXPECT_EQ(log.count_lines("The queue of slurm/test is held"), 1);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(client.wait_for_state(client.create(tiny_case()), v1::Job::SUCCEEDED));
  EXPECT_FALSE(is_serving(client.channel, "cellcrush.queue")) << "One queue is still held.";

  std::filesystem::create_symlink(CELLCRUSHD_PROGRAM, program);
  EXPECT_TRUE(client.wait_for_state(there, v1::Job::SUCCEEDED));
  EXPECT_TRUE(is_serving(client.channel, "cellcrush.queue"));
}

TEST_F(ExecutorsTest, AnOwnersLimitCountsOnEach) {
  auto options = with_program(CELLCRUSHD_PROGRAM);
  options.limits.owner.running_jobs = 1;
  start(options);
  auto client = this->client();
  const std::string here = client.create(endless_case());
  const std::string there = create_on(client, kCluster, endless_case());
  const std::string second = create_on(client, kCluster, endless_case());
  EXPECT_TRUE(client.wait_for_state(here, v1::Job::RUNNING));
  EXPECT_TRUE(client.wait_for_state(there, v1::Job::RUNNING));
  EXPECT_EQ(client.get(second).state(), v1::Job::PENDING);
  for (const auto& job : {second, here, there}) EXPECT_TRUE(client.cancel(job).ok());
}

TEST_F(ExecutorsTest, AClusterGivesAJobTheThreadsThatItAsksFor) {
  start(with_cluster(1));
  auto client = this->client();
  auto submitted = tiny_case();
  submitted.mutable_numerics()->set_threads(7);
  const std::string job = create_on(client, kCluster, submitted);
  ASSERT_TRUE(wait_for_place(client, job));
  EXPECT_THAT(cluster_.threads(), ElementsAre(7));
  EXPECT_TRUE(client.cancel(job).ok());
}

TEST_F(ExecutorsTest, WhereAClusterHasAJobIsShownUntilItEnds) {
  start(with_cluster());
  auto client = this->client();
  const std::string job = create_on(client, kCluster, endless_case());
  ASSERT_TRUE(wait_for_place(client, job));
  EXPECT_EQ(client.get(job).state(), v1::Job::PENDING);
  const std::string waits = "Cluster job 7, PENDING (Resources)";
  EXPECT_EQ(client.get(job).place(), waits);
  v1::ListJobsResponse listed;
  EXPECT_TRUE(client.jobs->ListJobs(bounded_context().get(), {}, &listed).ok());
  ASSERT_EQ(listed.jobs_size(), 1);
  EXPECT_EQ(listed.jobs(0).place(), waits);
  const auto queue = queue_of(client);
  ASSERT_EQ(queue.entries_size(), 1);
  EXPECT_EQ(queue.entries(0).reason(), "slurm/test has it: " + waits + ".");
  EXPECT_EQ(queue.entries(0).seconds_until_start(), 0.0);

  cluster_.open();
  ASSERT_TRUE(client.wait_for_state(job, v1::Job::RUNNING));
  EXPECT_EQ(client.get(job).place(), "Cluster job 7, RUNNING on node1");
  auto context = bounded_context();
  v1::WatchJobRequest request;
  request.set_name(job);
  auto watch = client.jobs->WatchJob(context.get(), request);
  v1::JobEvent first;
  ASSERT_TRUE(watch->Read(&first));
  EXPECT_EQ(first.snapshot().job().place(), "Cluster job 7, RUNNING on node1");
  context->TryCancel();
  EXPECT_TRUE(client.cancel(job).ok());
  ASSERT_TRUE(client.wait_for_state(job, v1::Job::CANCELLED));
  EXPECT_EQ(client.get(job).place(), "");
}

TEST_F(ExecutorsTest, ACancelReachesAJobThatItsClusterHasNotStarted) {
  start(with_cluster(4));
  auto client = this->client();
  const std::string alone = create_on(client, kCluster);
  const auto sweep = create_sweep_on(client, kCluster, tiny_case());
  ASSERT_TRUE(wait_until([&] { return cluster_.queued() == 4; }));
  EXPECT_TRUE(client.cancel(alone).ok());
  EXPECT_EQ(client.get(alone).state(), v1::Job::CANCELLED);
  EXPECT_TRUE(wait_until([&] { return cluster_.queued() == 3; }));
  v1::CancelSweepRequest request;
  request.set_name(sweep.name());
  v1::Sweep cancelled;
  EXPECT_TRUE(client.sweeps->CancelSweep(bounded_context().get(), request, &cancelled).ok());
  EXPECT_EQ(count_in(cancelled, v1::Job::CANCELLED), 3);
  EXPECT_TRUE(wait_until([&] { return cluster_.queued() == 0; }));
  // Its slots are free again.
  cluster_.open();
  EXPECT_TRUE(client.wait_for_state(create_on(client, kCluster), v1::Job::SUCCEEDED));
  EXPECT_EQ(client.get(alone).state(), v1::Job::CANCELLED);
}

TEST_F(ExecutorsTest, ASuspendedJobLeavesTheQueueOfItsCluster) {
  start(with_cluster(1));
  auto client = this->client();
  const std::string job = create_on(client, kCluster);
  ASSERT_TRUE(wait_for_place(client, job));
  EXPECT_TRUE(client.suspend(job).ok());
  EXPECT_EQ(client.get(job).state(), v1::Job::SUSPENDED);
  EXPECT_EQ(client.get(job).cause_message(), "") << "It has no checkpoint.";
  EXPECT_EQ(client.get(job).place(), "");
  EXPECT_EQ(cluster_.queued(), 0U);
  cluster_.open();
  EXPECT_TRUE(client.resume(job).ok());
  EXPECT_TRUE(client.wait_for_state(job, v1::Job::SUCCEEDED)) << client.get(job).cause_message();
}

TEST_F(ExecutorsTest, TheNextDaemonAdoptsWhatTheClusterHasBeforeItHandsOverMore) {
  start(with_cluster(2));
  std::vector<std::string> jobs;
  {
    auto client = this->client();
    for (int i = 0; i < 4; ++i) jobs.push_back(create_on(client, kCluster));
    ASSERT_TRUE(wait_until([&] { return cluster_.queued() == 2; }));
  }
  // One that is more urgent than those which the cluster has must not take a place from them.
  {
    auto client = this->client();
    v1::CreateJobRequest request;
    *request.mutable_case_() = tiny_case();
    request.set_executor(kCluster);
    request.set_priority(50);
    v1::Job urgent;
    ASSERT_TRUE(client.jobs->CreateJob(bounded_context().get(), request, &urgent).ok());
    jobs.push_back(urgent.name());
  }
  restart(with_cluster(2));
  auto client = this->client();
  ASSERT_TRUE(wait_for_place(client, jobs[0]));
  ASSERT_TRUE(wait_for_place(client, jobs[1]));
  EXPECT_EQ(cluster_.queued(), 2U);
  for (const auto& job : jobs) EXPECT_EQ(client.get(job).state(), v1::Job::PENDING);
  cluster_.open();
  for (const auto& job : jobs) EXPECT_TRUE(client.wait_for_state(job, v1::Job::SUCCEEDED)) << job;
  EXPECT_EQ(cluster_.threads().size(), 5U) << "Each was handed over once.";
}

TEST_F(ExecutorsTest, JobsOfAnExecutorThatIsGoneWaitAndCanBeCancelled) {
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
  const auto queue = queue_of(client);
  ASSERT_EQ(queue.entries_size(), 2);
  for (const auto& entry : queue.entries()) {
    EXPECT_EQ(entry.executor(), kCluster);
    EXPECT_THAT(entry.reason(), HasSubstr("This daemon does not have slurm/test"));
  }
  EXPECT_TRUE(queue.holds().empty());
  EXPECT_TRUE(is_serving(client.channel, "cellcrush.queue"));
  EXPECT_TRUE(client.suspend(placed).ok());
  EXPECT_TRUE(client.resume(placed).ok());
  EXPECT_EQ(client.get(placed).state(), v1::Job::PENDING);
  EXPECT_TRUE(client.cancel(waiting).ok());
  EXPECT_EQ(client.get(waiting).state(), v1::Job::CANCELLED);
  EXPECT_TRUE(client.remove(waiting).ok());

  cluster_.open();
  restart(with_cluster(1));
  auto again = this->client();
  EXPECT_TRUE(again.wait_for_state(placed, v1::Job::SUCCEEDED)) << again.get(placed).cause_message();
}

TEST_F(ExecutorsTest, AJobThatRunsOnAnExecutorThatIsGoneEndsOnceItIsCancelled) {
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
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_THAT(refused.error_message(), HasSubstr("jobs/1 runs on slurm/test"));
  EXPECT_TRUE(client.cancel(job).ok());
  EXPECT_EQ(client.get(job).state(), v1::Job::CANCELLED);
  EXPECT_THAT(client.get(job).cause_message(), HasSubstr("slurm/test"));
  EXPECT_TRUE(client.cancel(job).ok()) << "It is idempotent.";
  EXPECT_TRUE(client.remove(job).ok());
}

TEST_F(ExecutorsTest, ARetryStaysOnTheExecutorOfItsSweep) {
  start(with_program("/bin/false"));
  std::string name;
  v1::RetryFailedJobsRequest request;
  v1::Sweep sweep;
  {
    auto client = this->client();
    name = create_sweep_on(client, kCluster, tiny_case()).name();
    ASSERT_TRUE(wait_for_count(client, name, v1::Job::FAILED, 3));
    EXPECT_EQ(get_sweep(client, name).executor(), kCluster);
    request.set_name(name);
  }
  restart(default_options());
  {
    auto client = this->client();
    const auto refused = client.sweeps->RetryFailedJobs(bounded_context().get(), request, &sweep);
    EXPECT_EQ(refused.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
    EXPECT_THAT(refused.error_message(), HasSubstr("slurm/test, an executor that this daemon does not have"));
  }
  restart(with_program(CELLCRUSHD_PROGRAM));
  auto client = this->client();
  ASSERT_TRUE(client.sweeps->RetryFailedJobs(bounded_context().get(), request, &sweep).ok());
  EXPECT_TRUE(wait_for_count(client, name, v1::Job::SUCCEEDED, 3));
  sweep = get_sweep(client, name);
  for (const auto& job : sweep.jobs()) EXPECT_EQ(client.get(job).executor(), kCluster);
}

}  // namespace
}  // namespace cellcrush::testing

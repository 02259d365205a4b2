// Several executors in one daemon: what is chosen, what one cannot do to another, and what a cluster's queue holds.
#include <gmock/gmock.h>
#include <google/protobuf/util/time_util.h>

#include <csignal>
#include <mutex>
#include <set>
#include <vector>

#include "error.h"
#include "log_format.h"
#include "server/executors_fixture.h"
#include "server/log_capture.h"
#include "server/refuses.h"

namespace cellcrush::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

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
  const auto capabilities = answer_of(*v1::Admin::NewStub(client.channel), &v1::Admin::Stub::GetCapabilities, {});
  EXPECT_EQ(capabilities.default_executor(), kCluster);
  ASSERT_EQ(capabilities.executors_size(), 2);
  EXPECT_EQ(capabilities.executors(0).name(), "local");
  EXPECT_EQ(capabilities.executors(0).job_limit(), 2);
  EXPECT_EQ(capabilities.executors(1).name(), kCluster);
  EXPECT_EQ(capabilities.executors(1).job_limit(), 3);
  EXPECT_EQ(capabilities.worker_limit(), 2);
}

TEST_F(ExecutorsTest, TheStateOfADaemonHasItsAgeItsDiskAndItsJobs) {
  auto options = with_workers(1);
  options.limits.free_disk_bytes = 1'000'000;
  start(options);
  auto client = this->client();
  client.create(endless_case(), v1::Job::RUNNING);
  client.create(tiny_case());
  const auto state = answer_of(*v1::Admin::NewStub(client.channel), &v1::Admin::Stub::GetCapabilities, {});
  EXPECT_EQ(state.executors(0).running_count(), 1);
  EXPECT_EQ(state.waiting_count(), 1);
  EXPECT_GT(state.free_disk_bytes(), state.kept_disk_bytes());
  EXPECT_EQ(state.kept_disk_bytes(), 1'000'000);
  using google::protobuf::util::TimeUtil;
  const auto age = TimeUtil::DurationToSeconds(TimeUtil::GetCurrentTime() - state.start_time());
  EXPECT_TRUE(age >= 0 && age < 300) << age;
}

TEST_F(ExecutorsTest, ADefaultThatTheDaemonLacksIsRefused) {
  auto options = with_cluster();
  options.default_executor = "slurm/other";
  for (const char* words : {"--executor is \"slurm/other\"", "local, slurm/test"})
    EXPECT_THAT([&] { start(options); }, Refuses(ServiceError::Kind::invalid, words));
}

TEST_F(ExecutorsTest, AnUnknownOneIsRefusedWithThoseThereAre) {
  start(with_cluster());
  auto client = this->client();
  const auto refused = client.try_to(job_on("slurm/other"));
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  EXPECT_THAT(refused.error_message(),
              AllOf(HasSubstr("executor is \"slurm/other\""), HasSubstr("local, slurm/test"), HasSubstr("leave it")));
  EXPECT_EQ(client.try_to(job_on(std::string(200, 'x'))).error_code(), grpc::StatusCode::INVALID_ARGUMENT);
  auto request = sweep_of(tiny_case(), "plates.friction", {0.0, 0.1});
  request.mutable_sweep()->set_executor("slurm/other");
  const auto refused_sweep = client.try_to(request);
  EXPECT_THAT(refused_sweep, Fails(grpc::StatusCode::INVALID_ARGUMENT, "sweep.executor is \"slurm/other\""));
}

TEST_F(ExecutorsTest, TroubleOfOneHoldsItsOwnQueueOnly) {
  const LogCapture log(make_text_formatter());
  const auto program = folder_.path() / "program";
  start(with_program(program));
  auto client = this->client();
  const std::string there = create_on(client, kCluster);
  ASSERT_TRUE(wait_until([&] { return client.queue().holds_size() == 1; }));
  const auto queue = client.queue();
  EXPECT_EQ(queue.holds(0).executor(), kCluster);
  EXPECT_EQ(queue.holds(0).cause(), "worker");
  ASSERT_EQ(queue.entries_size(), 1);
  EXPECT_EQ(queue.entries(0).executor(), kCluster);
  EXPECT_FALSE(is_serving(client, "cellcrush.queue"));
  EXPECT_EQ(log.count_lines("The queue of slurm/test is held"), 1);
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(client.wait_for_state(client.create(tiny_case()), v1::Job::SUCCEEDED));
  EXPECT_FALSE(is_serving(client, "cellcrush.queue")) << "One queue is still held.";

  std::filesystem::create_symlink(CELLCRUSHD_PROGRAM, program);
  EXPECT_TRUE(client.wait_for_state(there, v1::Job::SUCCEEDED));
  EXPECT_TRUE(is_serving(client, "cellcrush.queue"));
}

TEST_F(ExecutorsTest, ItsThreadsAreThoseOfRunningJobs) {
  const auto threads = [] {
    using Entries = std::filesystem::directory_iterator;
    return std::distance(Entries("/proc/self/task"), Entries());
  };
  constexpr int kGrpcsOwn = 16;  // which come and go
  start(default_options());
  const auto without = threads();
  restart(with_cluster(300));
  EXPECT_LE(threads(), without + kGrpcsOwn);
  cluster_.open();
  auto client = this->client();
  std::vector<std::string> jobs;
  for (int i = 0; i < 20; ++i) jobs.push_back(create_on(client, kCluster));
  for (const auto& job : jobs) EXPECT_TRUE(client.wait_for_state(job, v1::Job::SUCCEEDED));
  EXPECT_TRUE(wait_until([&] { return threads() <= without + kGrpcsOwn; }));
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
  EXPECT_EQ(client.list().at(0).place(), waits);
  const auto queue = client.queue();
  ASSERT_EQ(queue.entries_size(), 1);
  EXPECT_EQ(queue.entries(0).reason(), "slurm/test has it: " + waits + ".");
  EXPECT_EQ(queue.entries(0).seconds_until_start(), 0.0);

  cluster_.open();
  ASSERT_TRUE(client.wait_for_state(job, v1::Job::RUNNING));
  EXPECT_EQ(client.get(job).place(), "Cluster job 7, RUNNING on node1");
  auto context = bounded_context();
  auto watch = client.jobs->WatchJob(context.get(), named<v1::WatchJobRequest>(job));
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
  EXPECT_EQ(count_in(cancel_sweep(client, sweep.name()), v1::Job::CANCELLED), 3);
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
    auto urgent = job_on(kCluster);
    urgent.set_priority(50);
    jobs.push_back(client.create(urgent).name());
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

// A cluster that computes on while this machine has no room for what it reports.
class KeepingCluster final : public jobs::Executor {
 public:
  struct Calls {
    std::mutex mutex;
    std::set<std::string> ended;
    int begun = 0;
  };
  explicit KeepingCluster(Calls& calls) : calls_(calls) {}

  bool has_worker(const store::JobFolder&) override { return false; }
  [[nodiscard]] bool keeps_workers() const override { return true; }
  std::optional<jobs::WorkerExit> read_final_report(const store::JobFolder&, const jobs::WorkerEvents&) override {
    return std::nullopt;
  }
  void end_worker(const store::JobFolder& folder) override {
    const std::lock_guard lock(calls_.mutex);
    calls_.ended.insert(folder.root().filename());
  }
  jobs::WorkerExit run(const store::JobFolder&, const worker::Order&, const jobs::WorkerEvents&,
                       const jobs::Interruptions&) override {
    {
      const std::lock_guard lock(calls_.mutex);
      ++calls_.begun;
    }
    throw ServiceError(Shortage::full_disk, "No room for reports.");
  }

 private:
  Calls& calls_;
};

// Nobody follows them any more, and their tasks would compute to the end.
TEST_F(ExecutorsTest, JobsOfAClusterThatAreCancelledDuringAShortageAreEndedThere) {
  KeepingCluster::Calls calls;
  auto options = default_options();
  options.hold_times = {std::chrono::milliseconds(20), std::chrono::milliseconds(50)};
  options.executors.push_back(
      {kCluster, 4, [&calls](const jobs::ExecutorSurroundings&) { return std::make_unique<KeepingCluster>(calls); }});
  start(options);
  auto client = this->client();
  const std::string single = create_on(client, kCluster);
  const auto sweep = create_sweep_on(client, kCluster, tiny_case());
  std::vector<std::string> jobs(sweep.jobs().begin(), sweep.jobs().end());
  jobs.push_back(single);
  ASSERT_TRUE(wait_until([&] {
    const std::lock_guard lock(calls.mutex);
    return calls.begun > 0;
  }));
  EXPECT_TRUE(client.cancel(single).ok());
  cancel_sweep(client, sweep.name());
  for (const auto& job : jobs) EXPECT_EQ(client.get(job).state(), v1::Job::CANCELLED);
  EXPECT_TRUE(wait_until([&] {
    const std::lock_guard lock(calls.mutex);
    return calls.ended.size() == jobs.size();
  }));
  daemon_.reset();
}

/// Workers of this machine, of which the first of each job is killed for lack of memory once it has reported a sample.
class ShortOfMemory final : public jobs::Executor {
 public:
  struct Seen {
    std::mutex mutex;
    std::vector<double> memory_factors;
  };
  ShortOfMemory(Seen& seen, bool at_own_limit, const jobs::ExecutorSurroundings& given)
      : seen_(seen), at_own_limit_(at_own_limit), workers_(given.worker_program, given.stall_limit) {}

  bool has_worker(const store::JobFolder& folder) override { return workers_.has_worker(folder); }
  std::optional<jobs::WorkerExit> read_final_report(const store::JobFolder& folder,
                                                    const jobs::WorkerEvents& events) override {
    return workers_.read_final_report(folder, events);
  }
  void end_worker(const store::JobFolder& folder) override { workers_.end_worker(folder); }

  jobs::WorkerExit run(const store::JobFolder& folder, const worker::Order& order, const jobs::WorkerEvents& events,
                       const jobs::Interruptions& interruptions) override {
    bool is_first = false;
    if (!order.has_given_up()) {
      const std::lock_guard lock(seen_.mutex);
      seen_.memory_factors.push_back(order.memory_factor());
      is_first = seen_.memory_factors.size() == 1;
    }
    if (!is_first) return workers_.run(folder, order, events, interruptions);
    std::stop_source end;
    auto until_a_sample = events;
    until_a_sample.reported = [&](worker::Report& report) {
      const bool is_sample = report.has_sample();
      events.reported(report);
      if (is_sample) end.request_stop();
    };
    workers_.run(folder, order, until_a_sample, {end.get_token(), {}, {}});
    jobs::WorkerExit out{.kind = jobs::WorkerExit::Kind::signalled, .code = SIGKILL};
    out.out_of_memory = true;
    out.at_own_limit = at_own_limit_;
    return out;
  }

 private:
  Seen& seen_;
  bool at_own_limit_;
  jobs::LocalProcess workers_;
};

TEST_F(ExecutorsTest, OnlyAWorkerThatRanIntoItsOwnLimitIsAllowedMoreMemory) {
  for (const bool at_own_limit : {false, true}) {
    ShortOfMemory::Seen seen;
    auto options = default_options();
    options.executors.push_back({kCluster, 1, [&](const jobs::ExecutorSurroundings& given) {
                                   return std::make_unique<ShortOfMemory>(seen, at_own_limit, given);
                                 }});
    restart(options);
    auto client = this->client();
    const std::string job = create_on(client, kCluster, endless_case());
    EXPECT_TRUE(wait_until([&] {
      const std::lock_guard lock(seen.mutex);
      return seen.memory_factors.size() == 2;
    }));
    EXPECT_TRUE(client.cancel(job).ok());
    daemon_.reset();
    EXPECT_THAT(seen.memory_factors, ElementsAre(1.0, at_own_limit ? 1.5 : 1.0));
  }
}

}  // namespace
}  // namespace cellcrush::testing

// A daemon with a Slurm cluster, as its users see it.
#include <gmock/gmock.h>

#include <set>
#include <sstream>

#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/job_numbers.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"
#include "slurm/cluster_options.h"
#include "slurm/slurm_cluster.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;

class SlurmDaemonTest : public DaemonFixture {
 protected:
  void SetUp() override {
    if (!slurm_is_installed()) GTEST_SKIP() << kSlurmIsMissing;
    cluster_ = std::make_unique<SlurmCluster>();
    setenv("SLURM_CONF", cluster_->config().c_str(), 1);
    start(with_cluster());
  }

  [[nodiscard]] DaemonOptions with_cluster() const {
    auto options = default_options();
    auto cluster = slurm::parse_cluster("test:folder=" + (cluster_->shared_folder() / "cellcrush").string() +
                                        ",program=" CELLCRUSHD_PROGRAM ",task-length=0");
    cluster.times.look = std::chrono::milliseconds(200);
    cluster.times.squeue = std::chrono::milliseconds(2'000);
    options.executors.push_back(slurm::executor_of(cluster));
    return options;
  }

  static std::string create_there(Client& client, const v1::Case& submitted) {
    auto request = job_of(submitted);
    request.set_executor("slurm/test");
    return client.create(request).name();
  }

  static std::string place_of(Client& client, const std::string& job, const std::string& words) {
    std::string place;
    wait_until(
        [&] {
          place = client.get(job).place();
          return place.find(words) != std::string::npos;
        },
        std::chrono::seconds(30));
    return place;
  }

  static void expect_equal(const std::vector<v1::Sample>& history, const std::vector<v1::Sample>& expected) {
    ASSERT_EQ(history.size(), expected.size());
    for (std::size_t k = 0; k < history.size(); ++k)
      ASSERT_EQ(history[k].SerializeAsString(), expected[k].SerializeAsString()) << "sample " << k;
  }

  std::unique_ptr<SlurmCluster> cluster_;
};

TEST_F(SlurmDaemonTest, AVelocitySweepOnTwoNodesHasTheBitsOfALocalOne) {
  Client client = this->client();
  auto request = sweep_of(case_of_seconds(), kSpeed, {2.0, 3.0, 5.0, 8.0, 13.0, 20.0});
  const auto here = create(client, request);
  request.mutable_sweep()->set_executor("slurm/test");
  const auto there = create(client, request);
  ASSERT_TRUE(wait_for_count(client, here.name(), v1::Job::SUCCEEDED, 6));
  ASSERT_TRUE(wait_for_count(client, there.name(), v1::Job::SUCCEEDED, 6)) << cluster_->logs();
  for (int i = 0; i < 6; ++i) {
    const auto job = client.get(get_sweep(client, there.name()).jobs(i));
    EXPECT_EQ(job.executor(), "slurm/test");
    EXPECT_EQ(job.attempt(), 1);
    expect_equal(client.history(job.name()), client.history(get_sweep(client, here.name()).jobs(i)));
  }
  std::istringstream lines(cluster_->run({"squeue", "--noheader", "--states=all", "--array", "--format=%N"}).output);
  std::set<std::string> nodes;
  for (std::string line; std::getline(lines, line);) nodes.insert(line);
  EXPECT_EQ(nodes, (std::set<std::string>{"n1", "n2"}));
  for (const char* left : {"attempts", "batches"})
    EXPECT_TRUE(wait_until([&] { return std::filesystem::is_empty(cluster_->shared_folder() / "cellcrush" / left); }))
        << left;
}

TEST_F(SlurmDaemonTest, AJobIsWatchedSuspendedResumedAndCancelledAsAnyOther) {
  Client client = this->client();
  const std::string job = create_there(client, endless_case());
  EXPECT_THAT(place_of(client, job, "RUNNING on n"), HasSubstr("Slurm job "));
  wait_for_samples(client, job, 5);
  EXPECT_TRUE(wait_until([&] { return client.get(job).progress().step() > 0; }));
  ASSERT_TRUE(client.suspend(job).ok());
  EXPECT_EQ(client.get(job).state(), v1::Job::SUSPENDED);
  EXPECT_EQ(client.get(job).place(), "");
  ASSERT_TRUE(client.resume(job).ok());
  ASSERT_TRUE(client.wait_for_state(job, v1::Job::RUNNING));
  wait_for_samples(client, job, client.history(job).size() + 5);
  ASSERT_TRUE(client.cancel(job).ok());
  EXPECT_TRUE(watch_soundly(client, job).ok()) << "No sample comes twice.";
  EXPECT_EQ(client.get(job).state(), v1::Job::CANCELLED);
  EXPECT_EQ(client.get(job).begun_again_sequence(), 0) << "It continued.";
  EXPECT_TRUE(client.get(job).has_summary());
}

TEST_F(SlurmDaemonTest, ADaemonThatEndsLeavesItsJobsToTheNextOne) {
  std::string job;
  std::string waiting;
  auto slow = case_of_seconds();
  slow.mutable_loading()->set_speed_m_per_s(1.0);
  slow.mutable_loading()->clear_end_time_s();
  {
    Client client = this->client();
    job = create_there(client, slow);
    waiting = create_there(client, slow);
    wait_for_samples(client, job, 5);
  }
  const auto begin = std::chrono::steady_clock::now();
  daemon_.reset();
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
  start(with_cluster());
  Client client = this->client();
  const std::string here = client.create(slow);
  ASSERT_TRUE(client.watch(here).status.ok());
  const auto expected = client.history(here);
  for (const auto& each : {job, waiting}) {
    expect_success(client, each);
    EXPECT_EQ(client.get(each).attempt(), 1);
    expect_equal(client.history(each), expected);
  }
}

TEST_F(SlurmDaemonTest, WhatTheAdministratorCancelsEndsWithItsReason) {
  Client client = this->client();
  const std::string job = create_there(client, endless_case());
  wait_for_samples(client, job, 5);
  ASSERT_EQ(cluster_->run({"scancel", "1"}).exit_code, 0);
  ASSERT_TRUE(client.wait_for_state(job, v1::Job::CANCELLED)) << client.get(job).DebugString();
  EXPECT_THAT(client.get(job).cause_message(), HasSubstr("Slurm job 1 was cancelled in Slurm"));
  EXPECT_TRUE(client.get(job).has_summary());
  // Also what waits there.
  ASSERT_EQ(cluster_->run({"scontrol", "update", "NodeName=n1,n2", "State=DRAIN", "Reason=test"}).exit_code, 0);
  const std::string waiting = create_there(client, endless_case());
  EXPECT_THAT(place_of(client, waiting, "PENDING"), HasSubstr("Slurm job 2"));
  ASSERT_EQ(cluster_->run({"scancel", "2"}).exit_code, 0);
  EXPECT_TRUE(client.wait_for_state(waiting, v1::Job::CANCELLED)) << client.get(waiting).DebugString();
}

TEST_F(SlurmDaemonTest, AClusterThatTakesNothingHoldsItsOwnQueueOnly) {
  Client client = this->client();
  ASSERT_EQ(cluster_->run({"scontrol", "update", "PartitionName=main", "State=DRAIN"}).exit_code, 0);
  const std::string there = create_there(client, tiny_case());
  const std::string here = client.create(tiny_case(), v1::Job::SUCCEEDED);
  ASSERT_TRUE(wait_until([&] { return client.queue().holds_size() == 1; }));
  const auto queue = client.queue();
  EXPECT_EQ(queue.holds(0).executor(), "slurm/test");
  EXPECT_EQ(queue.holds(0).cause(), "cluster");
  EXPECT_THAT(queue.holds(0).reason(), HasSubstr("sbatch said"));
  EXPECT_EQ(client.get(there).state(), v1::Job::PENDING);
  ASSERT_EQ(cluster_->run({"scontrol", "update", "PartitionName=main", "State=UP"}).exit_code, 0);
  EXPECT_TRUE(client.wait_for_state(there, v1::Job::SUCCEEDED));
}

}  // namespace
}  // namespace cellcrush::testing

// The cluster that tests use behaves as a real one, and leaves nothing behind.
#include "slurm/slurm_cluster.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <set>

#include "slurm/process_tree.h"

namespace cellcrush::testing {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;
using ::testing::HasSubstr;
using JobProcesses = SlurmCluster::JobProcesses;

constexpr seconds kLimit{60};

class SlurmClusterTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!slurm_is_installed()) GTEST_SKIP() << kSlurmIsMissing;
  }

  // Submits a job that runs the shell command; returns its number.
  static std::string submit(const SlurmCluster& cluster, std::vector<std::string> options, const std::string& command) {
    options.insert(options.begin(), {"sbatch", "--parsable", "-o", (cluster.shared_folder() / "%A_%a.out").string()});
    options.insert(options.end(), {"--wrap", command});
    const e2e::Outcome outcome = cluster.run(options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
    return outcome.output.substr(0, outcome.output.find('\n'));
  }

  static bool wait_for_state(const SlurmCluster& cluster, const std::string& job, const std::string& state) {
    return cluster.wait_for({"squeue", "-h", "-t", "all", "-j", job, "-o", "%T"}, state, kLimit);
  }

  static std::string bytes_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
};

TEST_F(SlurmClusterTest, AnArrayRunsOnBothNodes) {
  const SlurmCluster cluster;
  EXPECT_EQ(cluster.node_state(1), "idle");
  EXPECT_EQ(cluster.node_state(2), "idle");
  const std::string job = submit(cluster, {"--array=1-4"}, "echo $SLURMD_NODENAME; sleep 1; exit $SLURM_ARRAY_TASK_ID");
  EXPECT_EQ(cluster.wait_for_exit_codes(job, kLimit), (std::vector<int>{1, 2, 3, 4})) << cluster.logs();
  std::set<std::string> nodes;
  for (const char* task : {"_1.out", "_2.out", "_3.out", "_4.out"})
    nodes.insert(bytes_of(cluster.shared_folder() / (job + task)));
  EXPECT_EQ(nodes, (std::set<std::string>{"n1\n", "n2\n"}));
}

TEST_F(SlurmClusterTest, TwoOfThemDoNotDisturbEachOther) {
  const SlurmCluster cluster;
  const SlurmCluster other;
  const std::string job = submit(cluster, {}, "sleep 1000");
  EXPECT_TRUE(wait_for_state(cluster, job, "RUNNING"));
  EXPECT_EQ(other.run({"squeue", "-h"}).output, "");
}

TEST_F(SlurmClusterTest, AKilledNodeGoesDownAndItsJobStartsAgainWhenItIsBack) {
  SlurmCluster cluster;
  const std::string job = submit(cluster, {"--requeue", "-w", "n2"}, "sleep 1000");
  ASSERT_TRUE(wait_for_state(cluster, job, "RUNNING")) << cluster.logs();
  cluster.kill_node(2);
  ASSERT_TRUE(cluster.wait_for_node(2, "down*", kLimit)) << cluster.node_state(2);
  EXPECT_TRUE(wait_for_state(cluster, job, "PENDING"));
  cluster.start_node(2);
  EXPECT_TRUE(wait_for_state(cluster, job, "RUNNING")) << cluster.logs();
  EXPECT_TRUE(cluster.wait_for({"squeue", "-h", "-j", job, "-O", "RestartCnt:5"}, "1", kLimit));
}

TEST_F(SlurmClusterTest, JobsMaySurviveTheirNodeAndEndWithTheCluster) {
  pid_t survivor = 0;
  {
    SlurmCluster cluster;
    const fs::path written = cluster.shared_folder() / "pid";
    const std::string job = submit(cluster, {"-w", "n1"}, "echo $$ >" + written.string() + "; sleep 1000; true");
    ASSERT_TRUE(wait_for_state(cluster, job, "RUNNING")) << cluster.logs();
    ASSERT_TRUE(cluster.wait_for({"test", "-s", written.string()}, "", kLimit));
    survivor = std::stoi(bytes_of(written));
    cluster.kill_node(1, JobProcesses::survive);
    ASSERT_TRUE(cluster.wait_for_node(1, "down*", kLimit)) << cluster.node_state(1);
    EXPECT_EQ(program_of(survivor), "slurm_script");
    cluster.start_node(1);
    EXPECT_TRUE(cluster.wait_for_node(1, "idle", kLimit)) << cluster.node_state(1);
  }
  EXPECT_EQ(program_of(survivor), "");
}

TEST_F(SlurmClusterTest, JobsRunOnWhileTheControllerIsAway) {
  SlurmCluster cluster;
  const std::string job = submit(cluster, {}, "sleep 1000");
  ASSERT_TRUE(wait_for_state(cluster, job, "RUNNING")) << cluster.logs();
  cluster.stop_controller();
  EXPECT_NE(cluster.run({"squeue", "-h"}, seconds(30)).exit_code, 0);
  cluster.start_controller();
  EXPECT_TRUE(wait_for_state(cluster, job, "RUNNING")) << cluster.logs();
  EXPECT_EQ(cluster.run({"scancel", job}).exit_code, 0);
  EXPECT_TRUE(wait_for_state(cluster, job, "CANCELLED")) << cluster.logs();
}

TEST_F(SlurmClusterTest, AJobOfTheMainPartitionPreemptsOneOfTheLow) {
  const SlurmCluster cluster({.preempt_mode = "REQUEUE"});
  const std::string low = submit(cluster, {"-p", "low", "--requeue", "-w", "n1"}, "sleep 1000");
  ASSERT_TRUE(wait_for_state(cluster, low, "RUNNING")) << cluster.logs();
  const std::string main = submit(cluster, {"-w", "n1"}, "sleep 1000");
  EXPECT_TRUE(wait_for_state(cluster, main, "RUNNING")) << cluster.logs();
  EXPECT_TRUE(wait_for_state(cluster, low, "PENDING")) << cluster.logs();
}

TEST_F(SlurmClusterTest, AnEndedJobVanishesAfterItsMinimumAge) {
  const SlurmCluster cluster({.min_job_age_s = 2});
  const std::string job = submit(cluster, {}, "true");
  ASSERT_TRUE(wait_for_state(cluster, job, "COMPLETED")) << cluster.logs();
  EXPECT_TRUE(cluster.wait_for({"squeue", "-h", "-t", "all", "-o", "%i"}, "", 2 * kLimit));
  EXPECT_THAT(cluster.run({"squeue", "-h", "-j", job}).errors, HasSubstr("Invalid job id"));
}

class SlurmAccountingTest : public SlurmClusterTest {
 protected:
  void SetUp() override {
    if (!slurm_accounting_is_installed()) GTEST_SKIP() << kSlurmAccountingIsMissing;
  }

  // Whether `sacct` shows these lines of a job within the limit.
  static bool wait_for_record(const SlurmCluster& cluster, const std::string& job, const std::string& lines) {
    return cluster.wait_for({"sacct", "--noheader", "--parsable2", "--allocations", "--jobs=" + job,
                             "--format=JobID,State,NodeList,JobName"},
                            lines, kLimit);
  }
};

TEST_F(SlurmAccountingTest, EndedCancelledAndPendingJobsAreRecorded) {
  const SlurmCluster cluster({.accounting = true});
  const std::string user = std::to_string(geteuid());
  const std::string endless = submit(cluster, {"-J", "endless", "-w", "n1"}, "sleep 1000");
  const std::string ended = submit(cluster, {"-J", "ended", "-w", "n2"}, "true");
  const std::string array = submit(cluster, {"-J", "array", "-w", "n2", "--array=1-2"}, "exit $SLURM_ARRAY_TASK_ID");
  const std::string pending = submit(cluster, {"-J", "pending", "-w", "n1", "--array=1-5%2"}, "true");
  EXPECT_TRUE(wait_for_record(cluster, endless, endless + "|RUNNING|n1|endless")) << cluster.logs();
  EXPECT_TRUE(wait_for_record(cluster, ended, ended + "|COMPLETED|n2|ended")) << cluster.logs();
  EXPECT_TRUE(wait_for_record(cluster, array, array + "_1|FAILED|n2|array\n" + array + "_2|FAILED|n2|array"));
  EXPECT_TRUE(wait_for_record(cluster, pending, pending + "_[1-5%2]|PENDING|None assigned|pending"));
  EXPECT_EQ(cluster.run({"scancel", pending, endless}).exit_code, 0);
  const std::string cancelled = "|CANCELLED by " + user + "|";
  EXPECT_TRUE(wait_for_record(cluster, endless, endless + cancelled + "n1|endless")) << cluster.logs();
  EXPECT_TRUE(wait_for_record(cluster, pending, pending + "_[1-5%2]" + cancelled + "None assigned|pending"));
}

TEST_F(SlurmAccountingTest, AJobOnAKilledNodeIsRecordedAsFailedWithIt) {
  SlurmCluster cluster({.accounting = true});
  const std::string job = submit(cluster, {"-J", "lost", "--no-requeue", "-w", "n2"}, "sleep 1000");
  ASSERT_TRUE(wait_for_state(cluster, job, "RUNNING")) << cluster.logs();
  cluster.kill_node(2);
  EXPECT_TRUE(wait_for_record(cluster, job, job + "|NODE_FAIL|n2|lost")) << cluster.logs();
}

}  // namespace
}  // namespace cellcrush::testing

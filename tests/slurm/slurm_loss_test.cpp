// What becomes of jobs whose nodes, tasks or controller fail, and of those that somebody stops in Slurm itself.
#include <sys/mount.h>

#include <csignal>
#include <ctime>
#include <fstream>

#include "error.h"
#include "slurm/slurm_fixture.h"

namespace cellcrush::testing {
namespace {

using ::testing::AnyOf;
using ::testing::Eq;
using ::testing::HasSubstr;
using Kind = jobs::WorkerExit::Kind;
using std::chrono::milliseconds;
using std::chrono::seconds;

class SlurmLossTest : public SlurmFixture {
 protected:
  // The number of the Slurm job, from a place such as "Slurm job 17, RUNNING on n1".
  static std::string number_in(const std::string& place) {
    const auto begin = place.find("job ") + 4;
    return place.substr(begin, place.find_first_of(", ", begin) - begin);
  }

  static int node_in(const std::string& place) { return place.back() - '0'; }

  // Runs slow_case from where it was left to its end, with the bits of an undisturbed run. Not from step 0.
  void expect_continued() {
    const auto job = run(slow_case());
    const auto exit = job->wait();
    EXPECT_EQ(exit.kind, Kind::exited) << exit.detail;
    ASSERT_EQ(job->begun_steps().size(), 2U);
    EXPECT_GT(job->begun_steps().back(), 0);
    EXPECT_EQ(without_repeats(job->samples()), local_samples(slow_case()));
  }

  // Waits for the end of slow_case, which one worker computed from its first step to its last.
  void expect_undisturbed(ExecutorRun& job) {
    const auto exit = job.wait();
    EXPECT_EQ(exit.kind, Kind::exited) << exit.detail;
    EXPECT_EQ(job.begun_steps(), std::vector<std::int64_t>{0});
    EXPECT_EQ(job.samples(), local_samples(slow_case()));
  }

  // Leaves less than a block of `block_bytes` free.
  static void fill(const std::filesystem::path& folder, std::size_t block_bytes) {
    std::ofstream filler(folder / "filler", std::ios::binary);
    const std::string block(block_bytes, 'x');
    while (filler.write(block.data(), static_cast<std::streamsize>(block.size())).flush()) continue;
  }
};

// A file system of 4 MiB at a folder. Only root may mount.
class SmallDisk {
 public:
  explicit SmallDisk(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
    is_mounted_ = mount("tmpfs", folder_.c_str(), "tmpfs", 0, "size=4m,mode=0700") == 0;
  }
  ~SmallDisk() {
    if (is_mounted_) umount2(folder_.c_str(), MNT_DETACH);
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;

  [[nodiscard]] bool is_mounted() const { return is_mounted_; }

 private:
  std::filesystem::path folder_;
  bool is_mounted_ = false;
};

TEST_F(SlurmLossTest, AJobOfALostNodeContinuesOnAnotherWithTheSameBits) {
  start_cluster();
  start_executor();
  const auto job = run(slow_case());
  ASSERT_TRUE(job->wait_for_samples(80));
  cluster_->kill_node(node_in(job->wait_for_place("RUNNING on n")));
  const auto exit = job->wait();
  EXPECT_EQ(exit.kind, Kind::displaced) << exit.detail;
  EXPECT_THAT(exit.detail, AnyOf(HasSubstr("NODE_FAIL"), HasSubstr("no sign of life")));
  expect_continued();
}

// Slurm says that the node failed, and the task goes on: its heartbeat counts.
TEST_F(SlurmLossTest, ATaskThatOutlivesItsNodeIsNotComputedAgain) {
  start_cluster();
  start_executor();
  auto slow = slow_case();
  slow.mutable_loading()->set_speed_m_per_s(0.1);
  const auto job = run(slow);
  ASSERT_TRUE(job->wait_for_samples(5));
  const std::string place = job->wait_for_place("RUNNING on n");
  cluster_->kill_node(node_in(place), SlurmCluster::JobProcesses::survive);
  EXPECT_THAT(job->wait_for_place("NODE_FAIL"), HasSubstr("NODE_FAIL"));
  EXPECT_EQ(job->wait().kind, Kind::exited);
  EXPECT_EQ(job->begun_steps(), std::vector<std::int64_t>{0});
  EXPECT_EQ(job->samples(), local_samples(slow));
}

TEST_F(SlurmLossTest, AJobThatSlurmSuspendsStaysAndGoesOn) {
  start_cluster();
  auto options = quick_options();
  options.times.silent = milliseconds(7'000);
  options.times.lease = milliseconds(8'000);
  start_executor(options);
  const auto job = run(slow_case());
  ASSERT_TRUE(job->wait_for_samples(5));
  const std::string number = number_in(job->wait_for_place("RUNNING"));
  ASSERT_EQ(cluster_->run({"scontrol", "suspend", number}).exit_code, 0);
  EXPECT_THAT(job->wait_for_place("SUSPENDED"), HasSubstr("SUSPENDED"));
  // Longer than its lease, twice.
  std::this_thread::sleep_for(seconds(20));
  EXPECT_FALSE(job->has_ended());
  ASSERT_EQ(cluster_->run({"scontrol", "resume", number}).exit_code, 0);
  expect_undisturbed(*job);
}

TEST_F(SlurmLossTest, APreemptedJobContinuesLater) {
  start_cluster({.preempt_mode = "CANCEL"});
  auto options = quick_options();
  options.sbatch = {"--partition=low"};
  start_executor(options);
  const auto job = run(slow_case());
  ASSERT_TRUE(job->wait_for_samples(80));
  // Both nodes are wanted for a second.
  ASSERT_EQ(
      cluster_->run({"sbatch", "--partition=main", "--nodes=2", "--output=/dev/null", "--wrap", "sleep 1"}).exit_code,
      0);
  const auto exit = job->wait();
  EXPECT_THAT(exit.kind, AnyOf(Eq(Kind::displaced), Eq(Kind::stopped))) << exit.detail;
  expect_continued();
}

TEST_F(SlurmLossTest, AKilledTaskTakesItsWorkerAlongAndTheJobContinues) {
  start_cluster();
  start_executor();
  const auto job = run(slow_case());
  ASSERT_TRUE(job->wait_for_samples(80));
  const pid_t task = job->wait_for_start();
  ASSERT_EQ(kill(task, SIGKILL), 0);
  const auto exit = job->wait();
  EXPECT_EQ(exit.kind, Kind::gone) << exit.detail;
  EXPECT_THAT(exit.detail, HasSubstr("FAILED"));
  expect_continued();
}

// The clock of the nodes is an hour ahead of the daemon's.
TEST_F(SlurmLossTest, ClocksThatDifferDoNotMatter) {
  start_cluster();
  auto options = quick_options();
  options.program = folder_.path() / "shifted";
  std::ofstream(options.program) << "#!/bin/sh\nLD_PRELOAD=" SHIFTED_CLOCK_LIBRARY " exec " CELLCRUSHD_PROGRAM
                                    " \"$@\" 2>> "
                                 << (folder_.path() / "log").string() << "\n";
  std::filesystem::permissions(options.program, std::filesystem::perms::all);
  start_executor(options);
  const auto job = run(slow_case());
  expect_undisturbed(*job);
  // It was ahead.
  std::ifstream log(folder_.path() / "log");
  std::string day;
  std::string hour;
  log >> day >> hour;
  std::time_t later = std::time(nullptr) + 3600;
  char expected[16];
  std::strftime(expected, sizeof(expected), "%H", std::localtime(&later));
  EXPECT_EQ(hour.substr(0, 2), expected) << hour;
}

TEST_F(SlurmLossTest, AFullSharedFolderLosesNothing) {
  start_cluster();
  auto options = quick_options();
  options.folder = folder_.path() / "small";
  const SmallDisk disk(options.folder);
  if (!disk.is_mounted()) GTEST_SKIP() << "Only root may mount.";
  start_executor(options);
  {
    const auto job = run(slow_case());
    ASSERT_TRUE(job->wait_for_samples(20));
    fill(options.folder, 1 << 16);
    const std::size_t before = job->samples().size();
    std::this_thread::sleep_for(seconds(12));
    EXPECT_FALSE(job->has_ended());
    EXPECT_LT(job->samples().size(), 200U) << "The folder was not full: " << before;
    std::filesystem::remove(options.folder / "filler");
    expect_undisturbed(*job);
    // A new attempt finds no room either: its queue is held until there is some.
    fill(options.folder, 1 << 12);
    const auto next = run(tiny_case(), 2);
    try {
      next->wait();
      FAIL() << "There was room.";
    } catch (const ServiceError& error) {
      EXPECT_EQ(error.shortage(), Shortage::full_disk);
      EXPECT_THAT(error.what(), HasSubstr(options.folder.string()));
    }
  }
  executor_.reset();
}

// The task ends while the daemon has no room for what it computed: all of it waits in the attempt's folder.
TEST_F(SlurmLossTest, AFullDiskOfTheDaemonKeepsAResultInTheClusterUntilThereIsRoom) {
  const SmallDisk disk(folder_.path() / "jobs");
  if (!disk.is_mounted()) GTEST_SKIP() << "Only root may mount.";
  start_cluster();
  start_executor();
  {
    const auto job = run(slow_case());
    ASSERT_TRUE(job->wait_for_samples(5));
    fill(folder_.path() / "jobs", 1 << 10);
    EXPECT_THAT(job->wait_for_place("; "), HasSubstr(job_folder().root().string()));
    EXPECT_TRUE(cluster_->wait_for({"squeue", "--noheader"}, "", seconds(60)));
    std::this_thread::sleep_for(seconds(2));
    EXPECT_FALSE(job->has_ended());
    EXPECT_EQ(attempt_count(), 1U);
    std::filesystem::remove(folder_.path() / "jobs/filler");
    expect_undisturbed(*job);
    EXPECT_EQ(attempt_count(), 0U);
    EXPECT_GT(std::filesystem::file_size(job_folder().result()), 10'000U);
  }
  executor_.reset();
}

// Slurm starts the same job again where the site forces it to: the attempt is no longer free, and the daemon makes
// another one that continues.
TEST_F(SlurmLossTest, AJobThatIsRequeuedIsComputedByOneTaskAtATime) {
  start_cluster();
  auto options = quick_options();
  options.sbatch = {"--requeue"};
  options.program = logging_program();
  start_executor(options);
  const auto job = run(slow_case());
  ASSERT_TRUE(job->wait_for_samples(80));
  ASSERT_EQ(cluster_->run({"scontrol", "requeue", number_in(job->wait_for_place("RUNNING"))}).exit_code, 0);
  const auto exit = job->wait();
  EXPECT_THAT(exit.kind, AnyOf(Eq(Kind::stopped), Eq(Kind::displaced), Eq(Kind::gone))) << exit.detail;
  expect_continued();
  EXPECT_TRUE(cluster_->wait_for({"squeue", "--noheader"}, "", seconds(60)));
  EXPECT_EQ(count_in_log("begins"), 2);
}

TEST_F(SlurmLossTest, AProgramThatIsNotOnTheNodesIsNamed) {
  start_cluster();
  auto options = quick_options();
  options.program = "/nowhere/cellcrushd";
  start_executor(options);
  const auto exit = run(tiny_case())->wait();
  EXPECT_EQ(exit.kind, Kind::gone);
  EXPECT_THAT(exit.detail, HasSubstr("/nowhere/cellcrushd: not found"));
}

}  // namespace
}  // namespace cellcrush::testing

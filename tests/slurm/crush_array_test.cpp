// deploy/slurm/crush-array.sbatch on a cluster: what is computed, skipped, kept and queued again.
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <memory>

#include "slurm/slurm_cluster.h"

namespace cellcrush::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr std::chrono::seconds kArrayLimit{90};

constexpr const char* kSmallCase = R"(title: "A small specimen of hexagons"
lattice { hexagon { columns: 4 rows: 3 side_mm: 4 wall_thickness_mm: 0.3464 } }
depth_mm: 4
material { youngs_modulus_mpa: 69000 yield_stress_mpa: 76 density_kg_per_m3: 2700 }
loading { speed_m_per_s: 100 end_strain: 0.5 }
output { sample_count: 100 frame_count: 5 }
)";

// Takes several seconds, so that a signal finds it under way.
const std::string kSlowPoint = "loading.speed_m_per_s=0.08";

class CrushArray : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!slurm_is_installed()) GTEST_SKIP() << kSlurmIsMissing;
    cluster_ = std::make_unique<SlurmCluster>(SlurmOptions{.kill_wait_s = 20, .preempt_mode = "REQUEUE"});
    fs::create_directory(local());
    write("case.txtpb", kSmallCase);
  }

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder() / name) << text; }
  [[nodiscard]] fs::path folder() const { return cluster_->shared_folder(); }
  // Stands for the disk of the node.
  [[nodiscard]] fs::path local() const { return folder() / "local"; }
  [[nodiscard]] fs::path result_of(const std::string& point) const { return folder() / "results" / point; }
  static std::string bytes_of(const fs::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  // sbatch with these options, in the shared folder, with the programs of this build on the PATH.
  [[nodiscard]] e2e::Outcome submit(const std::vector<std::string>& options) const {
    const std::string programs = fs::path(CELLCRUSHD_PROGRAM).parent_path().string();
    std::vector<std::string> words = {"env",
                                      "PATH=" + programs + ":/usr/sbin:/usr/bin:/sbin:/bin",
                                      "SLURM_TMPDIR=" + local().string(),
                                      "sbatch",
                                      "-D",
                                      folder().string()};
    words.insert(words.end(), options.begin(), options.end());
    words.insert(words.end(), {CRUSH_ARRAY_SCRIPT, "case.txtpb", "points.txt", "results"});
    return cluster_->run(words, kArrayLimit);
  }

  // Submits an array and waits for its end.
  [[nodiscard]] std::vector<int> exit_codes(const std::string& array, const std::string& log) const {
    const e2e::Outcome outcome = submit({"--parsable", "--array=" + array, "-o", log});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
    return cluster_->wait_for_exit_codes(outcome.output.substr(0, outcome.output.find('\n')), kArrayLimit);
  }

  // Submits the slow point as an array of one task, waits until it is under way. Returns the name of the task.
  std::string submit_slow_point(const std::string& partition = "main") {
    write("points.txt", kSlowPoint + "\n");
    const e2e::Outcome outcome = submit({"--parsable", "--array=1-1", "-o", "log", "-p", partition, "-w", "n1"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
    const std::string samples = "grep -l sample " + (local() / "crush-array.*/run.json").string() + " | wc -l";
    EXPECT_TRUE(cluster_->wait_for({"sh", "-c", samples}, "1", kArrayLimit)) << bytes_of(log()) << cluster_->logs();
    return outcome.output.substr(0, outcome.output.find('\n')) + "_1";
  }
  [[nodiscard]] fs::path log() const { return folder() / "log"; }
  [[nodiscard]] bool wait_for_state(const std::string& task, const std::string& state) const {
    return cluster_->wait_for({"squeue", "-h", "-t", "all", "-j", task, "-o", "%T"}, state, kArrayLimit);
  }

  // history.csv of the slow point, crushed in one go by cellcrush run.
  [[nodiscard]] std::string history_in_one_go() const {
    const std::string output = (folder() / "one-go").string();
    const std::string program = fs::path(CELLCRUSHD_PROGRAM).replace_filename("cellcrush").string();
    EXPECT_EQ(
        e2e::run({program, "run", (folder() / "case.txtpb").string(), "--set", kSlowPoint, "-o", output}, kArrayLimit)
            .exit_code,
        0);
    return bytes_of(fs::path(output) / "history.csv");
  }

  std::unique_ptr<SlurmCluster> cluster_;
};

TEST_F(CrushArray, CrushesEachPointOnceAndGoesOnAfterAnInvalidOne) {
  write("points.txt",
        "loading.speed_m_per_s=50\nloading.speed_m_per_s=100\n"
        "loading.speed_m_per_s=150 numerics.time_step_s=-1\n\nloading.speed_m_per_s=200\n");
  EXPECT_THAT(exit_codes("1-2", "log-%a"), ElementsAre(0, 2))
      << bytes_of(folder() / "log-1") << bytes_of(folder() / "log-2");
  for (const char* point : {"loading.speed_m_per_s=50", "loading.speed_m_per_s=100", "loading.speed_m_per_s=200"}) {
    EXPECT_TRUE(fs::exists(result_of(point) / "case.txtpb")) << point;
    EXPECT_TRUE(fs::exists(result_of(point) / "result.h5")) << point;
  }
  EXPECT_FALSE(fs::exists(result_of("loading.speed_m_per_s=150,numerics.time_step_s=-1")));
  const auto written = fs::last_write_time(result_of("loading.speed_m_per_s=50") / "result.h5");
  EXPECT_THAT(exit_codes("1-1", "log-again"), ElementsAre(2));
  EXPECT_EQ(fs::last_write_time(result_of("loading.speed_m_per_s=50") / "result.h5"), written);
  const std::string again = bytes_of(folder() / "log-again");
  EXPECT_THAT(again, HasSubstr("time_step_s=-1: exit code 2"));
  EXPECT_THAT(again, HasSubstr("\"field\":\"numerics.time_step_s\"")) << "The log names the problem.";
  EXPECT_THAT(again, ::testing::Not(HasSubstr("loading.speed_m_per_s=50")));
}

TEST_F(CrushArray, BeforeItsTimeLimitATaskIsQueuedAgainAndEndsWithTheSameBits) {
  const std::string task = submit_slow_point();
  for (int i = 0; i < 2; ++i) ASSERT_EQ(cluster_->run({"scancel", "--batch", "--signal=USR1", task}).exit_code, 0);
  ASSERT_TRUE(wait_for_state(task, "PENDING")) << bytes_of(log());
  EXPECT_TRUE(fs::exists(result_of(kSlowPoint + ".unfinished"))) << bytes_of(log());
  EXPECT_THAT(bytes_of(log()), HasSubstr("exit code 130"));
  ASSERT_TRUE(wait_for_state(task, "COMPLETED")) << bytes_of(log());
  EXPECT_FALSE(fs::exists(result_of(kSlowPoint + ".unfinished")));
  EXPECT_EQ(bytes_of(result_of(kSlowPoint) / "history.csv"), history_in_one_go());
}

TEST_F(CrushArray, APreemptedTaskGoesOnOnceTheNodeIsFree) {
  const std::string task = submit_slow_point("low");
  ASSERT_EQ(cluster_->run({"sbatch", "-w", "n1", "-o", "/dev/null", "--wrap", "sleep 1"}).exit_code, 0);
  ASSERT_TRUE(wait_for_state(task, "PENDING")) << bytes_of(log());
  EXPECT_TRUE(fs::exists(result_of(kSlowPoint + ".unfinished"))) << bytes_of(log());
  EXPECT_THAT(bytes_of(log()), HasSubstr("exit code 130"));
  ASSERT_TRUE(wait_for_state(task, "COMPLETED")) << bytes_of(log());
  EXPECT_EQ(bytes_of(result_of(kSlowPoint) / "history.csv"), history_in_one_go());
}

TEST_F(CrushArray, ACancelledTaskKeepsItsWorkForTheNextArray) {
  const std::string task = submit_slow_point();
  ASSERT_EQ(cluster_->run({"scancel", task}).exit_code, 0);
  ASSERT_TRUE(wait_for_state(task, "CANCELLED")) << bytes_of(log());
  EXPECT_TRUE(fs::exists(result_of(kSlowPoint + ".unfinished"))) << bytes_of(log());
  EXPECT_THAT(exit_codes("1-1", "log"), ElementsAre(0)) << bytes_of(log());
  EXPECT_EQ(bytes_of(result_of(kSlowPoint) / "history.csv"), history_in_one_go());
}

TEST_F(CrushArray, ResultsOfAnotherCaseAreRefused) {
  write("points.txt", "loading.speed_m_per_s=100\n");
  EXPECT_THAT(exit_codes("1-1", "log"), ElementsAre(0)) << bytes_of(log());
  write("case.txtpb", std::string(kSmallCase) + "depth_mm: 5\n");
  EXPECT_THAT(exit_codes("1-1", "log"), ElementsAre(2));
  EXPECT_THAT(bytes_of(log()), HasSubstr("points of another case"));
}

TEST_F(CrushArray, AnArrayWithGapsIsRefused) {
  write("points.txt", "loading.speed_m_per_s=100\n");
  EXPECT_THAT(exit_codes("1,3", "log"), ElementsAre(2, 2));
  EXPECT_THAT(bytes_of(log()), HasSubstr("The array has gaps: 2 tasks from 1 to 3. Give --array=1-2."));
}

}  // namespace
}  // namespace cellcrush::testing

// Jobs that a real Slurm cluster computes.
#include <set>

#include "slurm/slurm_fixture.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;
using Kind = jobs::WorkerExit::Kind;

class SlurmExecutorTest : public SlurmFixture {
 protected:
  void SetUp() override {
    SlurmFixture::SetUp();
    if (IsSkipped()) return;
    start_cluster();
    start_executor();
  }
};

TEST_F(SlurmExecutorTest, AJobHasTheBitsOfALocalRunAndLeavesNothing) {
  const auto job = run(small_case());
  const auto exit = job->wait();
  EXPECT_EQ(exit.kind, Kind::exited) << exit.detail << exit.trouble.reason << cluster_->logs();
  ASSERT_TRUE(exit.final.has_value());
  EXPECT_TRUE(exit.final->has_summary());
  EXPECT_EQ(job->samples(), local_samples(small_case()));
  EXPECT_TRUE(std::filesystem::exists(job_folder().result()));
  EXPECT_FALSE(executor_->has_worker(job_folder()));
  EXPECT_EQ(attempt_count(), 0U);
  EXPECT_TRUE(std::filesystem::is_empty(quick_options().folder / "batches"));
}

// Each task takes jobs until it is predicted to run for the length of a task.
TEST_F(SlurmExecutorTest, JobsThatComeTogetherShareAnArrayAndShortOnesATask) {
  std::vector<std::unique_ptr<ExecutorRun>> jobs;
  std::set<std::string> places;
  for (int i = 1; i <= 4; ++i) jobs.push_back(run(endless_case(), i));
  for (const auto& job : jobs) {
    const std::string place = job->wait_for_place("Slurm job");
    places.insert(place.substr(0, place.find(',')));
  }
  for (const auto& job : jobs) job->cancel();
  for (const auto& job : jobs) EXPECT_EQ(job->wait().kind, Kind::cancelled);
  EXPECT_TRUE(cluster_->wait_for({"squeue", "--noheader", "--states=PENDING"}, "", std::chrono::seconds(20)))
      << "Two of them waited in Slurm.";
  EXPECT_THAT(*places.begin(), HasSubstr("_"));
  EXPECT_EQ(places.size(), 4U);

  auto options = quick_options();
  options.task_length = std::chrono::seconds(3600);
  start_executor(options);
  jobs.clear();
  places.clear();
  for (int i = 1; i <= 4; ++i) jobs.push_back(run(tiny_case(), 10 + i));
  for (const auto& job : jobs) places.insert(job->wait_for_place("Slurm job").substr(0, 11));
  for (const auto& job : jobs) EXPECT_TRUE(job->wait().final.has_value());
  EXPECT_EQ(places.size(), 1U);
  EXPECT_EQ(attempt_count(), 0U);
}

TEST_F(SlurmExecutorTest, ASuspendedJobContinuesWithTheSameBits) {
  auto job = run(slow_case());
  ASSERT_TRUE(job->wait_for_samples(10));
  job->suspend();
  const auto exit = job->wait();
  EXPECT_EQ(exit.kind, Kind::suspended);
  ASSERT_TRUE(exit.final.has_value());
  EXPECT_GT(exit.final->suspended_step(), 0);
  job = run(slow_case());
  EXPECT_EQ(job->wait().kind, Kind::exited);
  ASSERT_EQ(job->begun_steps().size(), 2U);
  EXPECT_EQ(job->begun_steps().back(), exit.final->suspended_step());
  EXPECT_EQ(without_repeats(job->samples()), local_samples(slow_case()));
}

}  // namespace
}  // namespace cellcrush::testing

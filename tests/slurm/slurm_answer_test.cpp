// What is asked of the commands of Slurm, and those that give no answer or a wrong one.
#include <unistd.h>

#include <fstream>
#include <set>

#include "slurm/slurm_fixture.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;
using Kind = jobs::WorkerExit::Kind;
using std::chrono::milliseconds;

class SlurmAnswerTest : public SlurmFixture {
 protected:
  void SetUp() override {
    SlurmFixture::SetUp();
    if (!IsSkipped()) start_cluster();
  }
};

TEST_F(SlurmAnswerTest, ASubmissionWithoutAnAnswerIsFoundByItsName) {
  auto options = quick_options();
  options.commands = replace_command("sbatch", "$REAL \"$@\" > /dev/null; exec sleep 100");
  options.times.command = milliseconds(1'000);
  options.program = logging_program();
  start_executor(options);
  const auto job = run(slow_case());
  EXPECT_THAT(job->wait_for_place("RUNNING"), HasSubstr("Slurm job 1,"));
  EXPECT_EQ(job->wait().kind, Kind::exited);
  EXPECT_EQ(count_in_log("begins"), 1);
  EXPECT_EQ(count_in_log("has ended", 1), 1);
}

// Neither found nor begun for long: it is taken back. What then starts in Slurm computes nothing.
TEST_F(SlurmAnswerTest, ASubmissionThatIsNotFoundIsTakenBackAndItsTaskComputesNothing) {
  auto options = quick_options();
  options.commands = replace_command("sbatch", "$REAL --begin=now+20 \"$@\" > /dev/null; exec sleep 100");
  options.commands = replace_command("squeue", "exit 0");
  options.times.command = milliseconds(1'000);
  options.times.unanswered = milliseconds(1'500);
  options.times.squeue = milliseconds(300);
  options.program = logging_program();
  start_executor(options);
  const auto exit = run(tiny_case())->wait();
  EXPECT_EQ(exit.kind, Kind::not_started);
  EXPECT_THAT(exit.trouble.reason, HasSubstr("did not answer in time"));
  EXPECT_EQ(attempt_count(), 0U);
  EXPECT_TRUE(cluster_->wait_for({"squeue", "--noheader"}, "", std::chrono::seconds(60)));
  EXPECT_EQ(count_in_log("begins"), 0);
}

// With accounting, a task that squeue has forgotten is still known.
TEST_F(SlurmAnswerTest, WhatSacctSaysOfASilentTaskCounts) {
  auto options = quick_options();
  options.commands = replace_command("squeue", "exit 0");
  options.commands = replace_command(
      "sacct",
      "echo \"$@\" >> $HERE/asked; echo \"1|OUT_OF_MEMORY|n7|$(/usr/bin/squeue --noheader --states=all --format=%j)\"");
  start_executor(options);
  const auto job = run_and_kill_task();
  const auto exit = job->wait();
  EXPECT_EQ(exit.kind, Kind::gone);
  EXPECT_TRUE(exit.out_of_memory);
  EXPECT_THAT(exit.detail, HasSubstr("Slurm job 1 on n7 ended without a last word: OUT_OF_MEMORY"));
  std::ifstream asked(options.commands / "asked");
  std::string line;
  EXPECT_TRUE(std::getline(asked, line));
  EXPECT_THAT(line, HasSubstr("--jobs=1 "));
}

// Each task takes jobs until it is predicted to run for the length of a task.
TEST_F(SlurmAnswerTest, JobsThatComeTogetherShareAnArrayAndShortOnesATask) {
  start_executor();
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

class SlurmAccountingTest : public SlurmFixture {
 protected:
  void SetUp() override {
    if (!slurm_accounting_is_installed()) GTEST_SKIP() << kSlurmAccountingIsMissing;
  }

  // Submits a job that runs the shell command; returns its number.
  std::string submit(std::vector<std::string> options, const std::string& command) {
    options.insert(options.begin(), {"sbatch", "--parsable", "-o", "/dev/null"});
    options.insert(options.end(), {"--wrap", command});
    const e2e::Outcome outcome = cluster_->run(options);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.all();
    return outcome.output.substr(0, outcome.output.find('\n'));
  }

  // Whether `sacct` shows these lines of a job in time.
  bool wait_for_record(const std::string& job, const std::string& lines) {
    return cluster_->wait_for({"sacct", "--noheader", "--parsable2", "--allocations", "--jobs=" + job,
                               "--format=JobID,State,NodeList,JobName"},
                              lines, std::chrono::seconds(60));
  }
};

// What parse_sacct_line (slurm_parts_test) reads is what sacct writes.
TEST_F(SlurmAccountingTest, EndedCancelledAndPendingJobsAreRecorded) {
  start_cluster({.accounting = true});
  const std::string user = std::to_string(geteuid());
  const std::string endless = submit({"-J", "endless", "-w", "n1"}, "sleep 1000");
  const std::string ended = submit({"-J", "ended", "-w", "n2"}, "true");
  const std::string array = submit({"-J", "array", "-w", "n2", "--array=1-2"}, "exit $SLURM_ARRAY_TASK_ID");
  const std::string pending = submit({"-J", "pending", "-w", "n1", "--array=1-5%2"}, "true");
  EXPECT_TRUE(wait_for_record(endless, endless + "|RUNNING|n1|endless")) << cluster_->logs();
  EXPECT_TRUE(wait_for_record(ended, ended + "|COMPLETED|n2|ended")) << cluster_->logs();
  EXPECT_TRUE(wait_for_record(array, array + "_1|FAILED|n2|array\n" + array + "_2|FAILED|n2|array"));
  EXPECT_TRUE(wait_for_record(pending, pending + "_[1-5%2]|PENDING|None assigned|pending"));
  EXPECT_EQ(cluster_->run({"scancel", pending, endless}).exit_code, 0);
  const std::string cancelled = "|CANCELLED by " + user + "|";
  EXPECT_TRUE(wait_for_record(endless, endless + cancelled + "n1|endless")) << cluster_->logs();
  EXPECT_TRUE(wait_for_record(pending, pending + "_[1-5%2]" + cancelled + "None assigned|pending"));
}

class SlurmAccountingAnswerTest : public SlurmAccountingTest {};

TEST_F(SlurmAccountingAnswerTest, ARealSacctTellsOfATaskThatSqueueHides) {
  start_cluster({.accounting = true});
  auto options = quick_options();
  options.commands = replace_command("squeue", "exit 0");
  options.times.lease = std::chrono::minutes(10);
  start_executor(options);
  const auto job = run_and_kill_task();
  const auto exit = job->wait();
  EXPECT_EQ(exit.kind, Kind::gone);
  EXPECT_THAT(exit.detail, HasSubstr("ended without a last word: FAILED"));
}

// Neither sacct nor squeue knows of the task: that proves nothing, and its lease has to be over, twice.
TEST_F(SlurmAnswerTest, ASilentTaskOfWhichNobodyKnowsIsGivenUpAfterItsLease) {
  auto options = quick_options();
  options.commands = replace_command("squeue", "exit 0");
  options.times.lease = milliseconds(8'000);
  start_executor(options);
  const auto job = run_and_kill_task();
  const auto begin = std::chrono::steady_clock::now();
  const auto exit = job->wait();
  EXPECT_GT(std::chrono::steady_clock::now() - begin, milliseconds(12'000));
  EXPECT_EQ(exit.kind, Kind::displaced);
  EXPECT_THAT(exit.detail, HasSubstr("no sign of life for 16 s"));
}

// Each line is hidden at random, of jobs that run and of jobs that wait for long.
TEST_F(SlurmAnswerTest, JobsThatSqueueHidesNowAndThenAreComputedOnce) {
  auto options = quick_options();
  options.commands = replace_command("squeue",
                                     "$REAL \"$@\" | awk -v seed=$$ -v hidden=$HERE/hidden "
                                     "'BEGIN { srand(seed) } rand() > 0.05 { print; next } { print >> hidden }'");
  options.times.squeue = milliseconds(100);
  options.times.unanswered = milliseconds(1'000);
  options.program = logging_program();
  start_executor(options);
  std::vector<std::unique_ptr<ExecutorRun>> jobs;
  for (int i = 1; i <= 12; ++i) jobs.push_back(run(slow_case(), i));
  for (const auto& job : jobs) {
    EXPECT_EQ(job->wait().kind, Kind::exited) << job->wait().detail;
    EXPECT_EQ(job->begun_steps(), std::vector<std::int64_t>{0});
  }
  std::ifstream hidden(options.commands / "hidden");
  const std::string lines(std::istreambuf_iterator<char>(hidden), {});
  EXPECT_THAT(lines, HasSubstr("RUNNING"));
  EXPECT_THAT(lines, HasSubstr("PENDING"));
  EXPECT_EQ(count_in_log("begins"), 12);
  EXPECT_EQ(count_in_log("has ended", 12), 12);
}

TEST_F(SlurmAnswerTest, AStateThatIsNotKnownIsShown) {
  auto options = quick_options();
  options.commands = replace_command("squeue", "$REAL \"$@\" | sed 's/RUNNING/TELEPORTING/'; echo broken line");
  start_executor(options);
  const auto job = run(slow_case());
  EXPECT_THAT(job->wait_for_place("TELEPORTING"), HasSubstr("TELEPORTING on n"));
  EXPECT_EQ(job->wait().kind, Kind::exited);
}

// Two tasks of one attempt, as when Slurm starts a job again: the second computes nothing.
TEST_F(SlurmAnswerTest, AnAttemptIsComputedByOneTask) {
  auto options = quick_options();
  options.commands = replace_command("sbatch", "$REAL \"$@\" > /dev/null; exec $REAL \"$@\"");
  options.program = logging_program();
  start_executor(options);
  const auto job = run(slow_case());
  EXPECT_EQ(job->wait().kind, Kind::exited);
  EXPECT_TRUE(cluster_->wait_for({"squeue", "--noheader"}, "", std::chrono::seconds(30)));
  EXPECT_EQ(count_in_log("begins"), 1);
  EXPECT_EQ(count_in_log("is not this task's") + count_in_log("has no task 0 any more"), 1);
}

}  // namespace
}  // namespace cellcrush::testing

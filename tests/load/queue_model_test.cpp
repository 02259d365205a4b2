#include "load/queue_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "load/cost_rounds.h"
#include "load/job_runs.h"
#include "server/small_case.h"
#include "server/temporary_folder.h"

namespace cellcrush::load {
namespace {

Workload even(int jobs, int slots, double run_s) {
  Workload out;
  out.jobs = jobs;
  out.slots = slots;
  out.run_s = run_s;
  out.samples = 0.0;
  return out;
}

TEST(QueueModel, WithoutCostsTheSlotsRunInRounds) {
  const Outcome outcome = simulate(even(100, 8, 3.0), {});
  EXPECT_NEAR(outcome.makespan_s, 13 * 3.0, 1e-9) << "100 jobs in 8 slots are 13 rounds.";
  EXPECT_EQ(outcome.daemon_cpu_s, 0.0);
  EXPECT_NEAR(outcome.busy_share, 100.0 / (13 * 8), 1e-9);
}

TEST(QueueModel, OneSlotPaysItsGapTwoCommitsAndTheProcessorForEachJob) {
  DaemonCosts costs;
  costs.job_cpu_s = 0.004;
  costs.slot_gap_s = 0.02;
  costs.commit_s = 0.003;
  costs.change_s = 0.0005;
  const Outcome outcome = simulate(even(50, 1, 1.0), costs);
  EXPECT_NEAR(outcome.makespan_s, 50 * (1.0 + 0.02 + 0.004 + 2 * 0.0035), 1e-9);
  EXPECT_NEAR(outcome.change_latency_s, 0.0035, 1e-9);
  EXPECT_NEAR(outcome.daemon_cpu_s, 50 * 0.004, 1e-9);
}

// Many slots with short jobs share commits, but each change takes its time in the journal's turn: with two changes a
// job, at most 1 / (2 change_s) jobs a second.
TEST(QueueModel, TheJournalBoundsTheJobsASecond) {
  DaemonCosts costs;
  costs.commit_s = 0.002;
  costs.change_s = 0.001;
  Workload workload = even(20'000, 2000, 1.0);
  workload.run_spread = 0.3;
  const Outcome outcome = simulate(workload, costs);
  EXPECT_LT(outcome.jobs_per_s, 500.0);
  EXPECT_GT(outcome.jobs_per_s, 400.0);
  EXPECT_GT(outcome.journal_share, 0.9);
  EXPECT_GT(outcome.change_latency_s, 0.5) << "2000 slots wait for 500 jobs a second.";
}

TEST(QueueModel, ABatchSystemThatStartsEverySoOftenBoundsThemToo) {
  Workload workload = even(200, 200, 1.0);
  workload.start_interval_s = 0.5;
  EXPECT_NEAR(simulate(workload, {}).makespan_s, 199 * 0.5 + 1.0, 1e-9);
}

TEST(QueueModel, RunTimesHaveTheirMeanAndTheSameSeedGivesTheSameBits) {
  Workload workload = even(20'000, 10, 5.0);
  workload.run_spread = 0.5;
  const Outcome outcome = simulate(workload, {});
  EXPECT_NEAR(outcome.makespan_s, 20'000 * 5.0 / 10, 0.02 * 10'000);
  EXPECT_EQ(simulate(workload, {}).makespan_s, outcome.makespan_s);
  workload.seed = 2;
  EXPECT_NE(simulate(workload, {}).makespan_s, outcome.makespan_s);
}

TEST(QueueModel, AMissingFigureIsNamed) {
  try {
    costs_of({{"commit_s", 1.0}});
    ADD_FAILURE() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("job_cpu_s"), std::string::npos);
  }
}

// The figures come from jobs that run one after the other, before and apart from those that are predicted.
TEST(LongQueueModel, PredictsARealRunOfTwoHundredSmallJobs) {
  Rounds rounds;
  for (int i = 0; i < 3; ++i) {
    measure_journal(rounds);
    measure_runs(30, rounds);
  }
  measure_daemon(rounds);
  const DaemonCosts costs = costs_of(medians_of(rounds));
  constexpr int kJobs = 200;
  constexpr int kWorkers = 2;
  const Outcome predicted = simulate(small_jobs(kJobs, kWorkers, 2.0, costs), costs);
  const testing::TemporaryFolder folder;
  const JobRuns real = run_jobs(folder.path(), testing::small_case(), kJobs, kWorkers);
  EXPECT_NEAR(predicted.makespan_s, real.makespan_s, 0.35 * real.makespan_s);
  EXPECT_NEAR(predicted.daemon_cpu_s, real.daemon_s, 0.4 * real.daemon_s);
  EXPECT_NEAR(predicted.journal_bytes, real.journal_bytes, 0.1 * real.journal_bytes);
  EXPECT_NEAR(predicted.result_bytes, real.result_bytes, 0.05 * real.result_bytes);
}

}  // namespace
}  // namespace cellcrush::load

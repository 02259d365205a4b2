#include "jobs/outcome.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cerrno>
#include <csignal>
#include <utility>

#include "error.h"
#include "worker/worker_main.h"

namespace cellcrush::jobs {
namespace {

using ::testing::HasSubstr;

WorkerExit exit_of(WorkerExit::Kind kind, int code) {
  WorkerExit out;
  out.kind = kind;
  out.code = code;
  return out;
}

TEST(Outcome, ASignalIsNamed) {
  const auto out = outcome_of(exit_of(WorkerExit::Kind::signalled, SIGSEGV));
  EXPECT_EQ(out.state, v1::Job::FAILED);
  EXPECT_EQ(out.cause, v1::Job::WORKER_CRASHED);
  EXPECT_THAT(out.message, HasSubstr("SIGSEGV (11)"));
  EXPECT_FALSE(out.remedy.empty());
}

TEST(Outcome, AnEndWithoutAFinalReportIsACrashWithItsExitCode) {
  const auto out = outcome_of(exit_of(WorkerExit::Kind::exited, 3));
  EXPECT_EQ(out.cause, v1::Job::WORKER_CRASHED);
  EXPECT_THAT(out.message, HasSubstr("exited with code 3"));
}

TEST(Outcome, AFinalReportCountsForMoreThanTheEndOfTheProcess) {
  auto exit = exit_of(WorkerExit::Kind::signalled, SIGKILL);
  exit.final.emplace();
  exit.final->mutable_summary()->set_step_count(7);
  const auto out = outcome_of(exit);
  EXPECT_EQ(out.state, v1::Job::SUCCEEDED);
  ASSERT_TRUE(out.summary);
  EXPECT_EQ(out.summary->step_count(), 7);
}

TEST(Outcome, ADivergedRunKeepsTheSolversWords) {
  auto exit = exit_of(WorkerExit::Kind::exited, 0);
  exit.final.emplace();
  exit.final->set_cause(v1::Job::SOLVER_DIVERGED);
  exit.final->set_message("Particle 3 is not a number.");
  exit.final->set_remedy("Take a smaller step.");
  const auto out = outcome_of(exit);
  EXPECT_EQ(out.state, v1::Job::FAILED);
  EXPECT_EQ(out.cause, v1::Job::SOLVER_DIVERGED);
  EXPECT_EQ(out.message, "Particle 3 is not a number.");
  EXPECT_EQ(out.remedy, "Take a smaller step.");
}

TEST(Outcome, ARunThatTheSolverFoundUntrueKeepsWhatItComputedBefore) {
  auto exit = exit_of(WorkerExit::Kind::exited, 0);
  exit.final.emplace();
  exit.final->set_cause(v1::Job::CONTACT_ENERGY);
  exit.final->mutable_summary()->set_step_count(7);
  const auto out = outcome_of(exit);
  EXPECT_EQ(out.state, v1::Job::FAILED);
  ASSERT_TRUE(out.summary);
  EXPECT_EQ(out.summary->step_count(), 7);
}

TEST(Outcome, AJobThatWasLeftWaitsOrIsSuspended) {
  EXPECT_EQ(outcome_of(exit_of(WorkerExit::Kind::stopped, 0)).state, v1::Job::PENDING);
  auto suspended = exit_of(WorkerExit::Kind::suspended, 0);
  EXPECT_EQ(outcome_of(suspended).state, v1::Job::SUSPENDED);
  suspended.final.emplace();
  suspended.final->set_suspended_step(1234);
  EXPECT_EQ(outcome_of(suspended).state, v1::Job::SUSPENDED);
  EXPECT_THAT(outcome_of(suspended).message, HasSubstr("step 1234"));
}

TEST(Outcome, OnlyALossWithoutALastWordIsALoss) {
  using Kind = WorkerExit::Kind;
  for (const auto kind : {Kind::exited, Kind::signalled, Kind::gone, Kind::broken, Kind::stalled}) {
    auto exit = exit_of(kind, 1);
    EXPECT_TRUE(is_lost(exit));
    EXPECT_EQ(outcome_of(exit).cause, v1::Job::WORKER_CRASHED);
    const auto again = tried_again(outcome_of(exit));
    EXPECT_EQ(again.state, v1::Job::PENDING);
    EXPECT_EQ(again.cause, v1::Job::JOB_CAUSE_UNSPECIFIED);
    EXPECT_THAT(again.message, HasSubstr("last checkpoint"));
    exit.final.emplace();
    exit.final->set_cause(v1::Job::SOLVER_DIVERGED);
    EXPECT_FALSE(is_lost(exit)) << "A diverged solution is not tried again.";
  }
  for (const auto kind : {Kind::stopped, Kind::suspended, Kind::cancelled}) EXPECT_FALSE(is_lost(exit_of(kind, 0)));
}

TEST(Outcome, AWorkerThatAnotherProgramMadeLeaveIsALoss) {
  auto exit = exit_of(WorkerExit::Kind::exited, 0);
  exit.final.emplace();
  exit.final->set_suspended_step(7);
  EXPECT_TRUE(is_lost(exit));
  EXPECT_THAT(outcome_of(exit).message, HasSubstr("Another program"));
}

TEST(Outcome, ACancelledRunKeepsItsSummaryIfItHasOne) {
  auto exit = exit_of(WorkerExit::Kind::cancelled, 0);
  EXPECT_EQ(outcome_of(exit).state, v1::Job::CANCELLED);
  EXPECT_FALSE(outcome_of(exit).summary);
  EXPECT_FALSE(outcome_of(exit).message.empty());
  exit.final.emplace();
  exit.final->set_cancelled(true);
  exit.final->mutable_summary()->set_step_count(5);
  const auto out = outcome_of(exit);
  EXPECT_EQ(out.state, v1::Job::CANCELLED);
  ASSERT_TRUE(out.summary);
  EXPECT_EQ(out.summary->step_count(), 5);
}

TEST(Outcome, ARunThatWasDoneBeforeItWasCancelledHasSucceeded) {
  auto exit = exit_of(WorkerExit::Kind::cancelled, 0);
  exit.final.emplace();
  exit.final->mutable_summary();
  EXPECT_EQ(outcome_of(exit).state, v1::Job::SUCCEEDED);
}

TEST(Outcome, AShortageIsNoEndOfTheJobItIsFoundInWhatTheWorkerSaidOrInItsExitCode) {
  using Kind = WorkerExit::Kind;
  for (const auto& [exit, shortage] : {std::pair{exit_of(Kind::not_started, ENOENT), Shortage::worker},
                                       std::pair{exit_of(Kind::not_started, EACCES), Shortage::worker},
                                       std::pair{exit_of(Kind::not_started, EAGAIN), Shortage::memory},
                                       std::pair{exit_of(Kind::not_started, EMFILE), Shortage::descriptors},
                                       std::pair{exit_of(Kind::exited, 127), Shortage::worker}}) {
    EXPECT_TRUE(is_lost(exit));
    EXPECT_EQ(trouble_of_exit(exit).shortage, shortage) << exit.code;
  }
  const ServiceError full(Shortage::full_disk, "The disk is full.");
  EXPECT_EQ(trouble_of_exit(exit_of(Kind::exited, worker::exit_code_of(full))).shortage, Shortage::full_disk);
  auto exit = exit_of(Kind::gone, 0);
  EXPECT_FALSE(trouble_of_exit(exit));
  exit.final.emplace();
  exit.final->set_suspended_step(7);
  exit.final->set_shortage(static_cast<int>(Shortage::full_disk));
  exit.final->set_message("result.h5 cannot be written.");
  EXPECT_FALSE(is_last_word(exit));
  const auto waits = waits_for(trouble_of_exit(exit));
  EXPECT_EQ(waits.state, v1::Job::PENDING);
  EXPECT_EQ(waits.cause, v1::Job::JOB_CAUSE_UNSPECIFIED);
  EXPECT_THAT(waits.message, HasSubstr("result.h5 cannot be written."));
  EXPECT_THAT(waits.remedy, HasSubstr("Free space"));
}

TEST(Outcome, AWorkerThatTheKernelEndedForWantOfMemoryIsOutOfMemory) {
  auto exit = exit_of(WorkerExit::Kind::signalled, SIGKILL);
  exit.out_of_memory = true;
  EXPECT_TRUE(is_lost(exit));
  EXPECT_EQ(outcome_of(exit).cause, v1::Job::OUT_OF_MEMORY);
  EXPECT_THAT(outcome_of(exit).remedy, HasSubstr("--workers"));
}

TEST(Outcome, OtherFailuresOfTheDaemonEndTheJob) {
  EXPECT_EQ(outcome_of(std::runtime_error("other")).cause, v1::Job::WORKER_CRASHED);
}

}  // namespace
}  // namespace cellcrush::jobs

// What becomes of a job whose worker has ended.
#include "jobs/outcome.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cerrno>
#include <csignal>
#include <fstream>
#include <utility>

#include "error.h"
#include "jobs/local_process.h"
#include "programs/temporary_folder.h"
#include "worker/worker_main.h"

namespace cellcrush::jobs {
namespace {

using ::testing::HasSubstr;
using Kind = WorkerExit::Kind;

WorkerExit exit_of(Kind kind, int code) {
  WorkerExit out;
  out.kind = kind;
  out.code = code;
  return out;
}

// With a final report that has a summary, or a cause of failure.
WorkerExit with_summary(Kind kind, v1::Job::Cause cause = v1::Job::JOB_CAUSE_UNSPECIFIED) {
  auto out = exit_of(kind, 0);
  out.final.emplace().set_cause(cause);
  out.final->mutable_summary()->set_step_count(7);
  return out;
}

TEST(Outcome, AFinalReportCountsForMoreThanTheEndOfTheProcess) {
  for (const auto& [exit, state] : {std::pair{with_summary(Kind::signalled), v1::Job::SUCCEEDED},
                                    std::pair{with_summary(Kind::exited, v1::Job::CONTACT_ENERGY), v1::Job::FAILED},
                                    std::pair{with_summary(Kind::cancelled), v1::Job::SUCCEEDED}}) {
    const auto out = outcome_of(exit);
    EXPECT_EQ(out.state, state);
    ASSERT_TRUE(out.summary);
    EXPECT_EQ(out.summary->step_count(), 7);
  }
}

TEST(Outcome, ADivergedRunKeepsTheSolversWords) {
  auto exit = exit_of(Kind::exited, 0);
  exit.final.emplace().set_cause(v1::Job::SOLVER_DIVERGED);
  exit.final->set_message("Particle 3 is not a number.");
  exit.final->set_remedy("Take a smaller step.");
  const auto out = outcome_of(exit);
  EXPECT_EQ(out.state, v1::Job::FAILED);
  EXPECT_EQ(out.cause, v1::Job::SOLVER_DIVERGED);
  EXPECT_EQ(out.message, "Particle 3 is not a number.");
  EXPECT_EQ(out.remedy, "Take a smaller step.");
}

TEST(Outcome, OnlyALossWithoutALastWordIsALoss) {
  for (const auto kind : {Kind::exited, Kind::signalled, Kind::gone, Kind::broken, Kind::stalled}) {
    auto exit = exit_of(kind, 1);
    EXPECT_TRUE(is_lost(exit));
    EXPECT_EQ(outcome_of(exit).cause, v1::Job::WORKER_CRASHED);
    const auto again = tried_again(outcome_of(exit));
    EXPECT_EQ(again.state, v1::Job::PENDING);
    EXPECT_EQ(again.cause, v1::Job::JOB_CAUSE_UNSPECIFIED);
    EXPECT_THAT(again.message, HasSubstr("last checkpoint"));
    exit.final.emplace().set_cause(v1::Job::SOLVER_DIVERGED);
    EXPECT_FALSE(is_lost(exit)) << "A diverged solution is not tried again.";
  }
  for (const auto kind : {Kind::stopped, Kind::suspended, Kind::cancelled}) EXPECT_FALSE(is_lost(exit_of(kind, 0)));
}

TEST(Outcome, AWorkerThatLeftWithoutBeingAskedIsALoss) {
  auto exit = exit_of(Kind::suspended, 0);
  exit.final.emplace().set_suspended_step(1234);
  EXPECT_EQ(outcome_of(exit).state, v1::Job::SUSPENDED);
  EXPECT_THAT(outcome_of(exit).message, HasSubstr("step 1234"));
  exit.kind = Kind::exited;
  EXPECT_TRUE(is_lost(exit));
  EXPECT_THAT(outcome_of(exit).message, HasSubstr("Another program"));
}

TEST(Outcome, AShortageIsNoEndOfTheJobItIsFoundInWhatTheWorkerSaidOrInItsExitCode) {
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
  exit.final.emplace().set_suspended_step(7);
  exit.final->set_shortage(static_cast<int>(Shortage::full_disk));
  exit.final->set_message("result.h5 cannot be written.");
  EXPECT_FALSE(is_last_word(exit));
  const auto waits = waits_for(trouble_of_exit(exit));
  EXPECT_EQ(waits.state, v1::Job::PENDING);
  EXPECT_EQ(waits.cause, v1::Job::JOB_CAUSE_UNSPECIFIED);
  EXPECT_THAT(waits.message, HasSubstr("result.h5 cannot be written."));
  EXPECT_THAT(waits.remedy, HasSubstr("Free space"));
}

class OomKillTest : public ::testing::Test {
 protected:
  OomKillTest() {
    std::filesystem::create_directory(job_.root());
    std::ofstream(program()) << "#!/bin/sh\nkill -9 $$\n";
    EXPECT_EQ(chmod(program().c_str(), 0700), 0);
  }

  [[nodiscard]] std::filesystem::path program() const { return folder_.path() / "worker"; }

  // How a worker that is killed ends when the kernel has killed so many processes before it starts and when it has
  // ended.
  WorkerExit run(std::uint64_t before, std::uint64_t after) const {
    LocalProcess executor(program(), std::chrono::seconds(20), [before, after, asked = false]() mutable {
      return std::exchange(asked, true) ? after : before;
    });
    WorkerEvents events;
    events.started = [](int) {};
    events.reported = [](worker::Report&) {};
    events.watched = [] { return false; };
    return executor.run(job_, worker::Order(), events, {});
  }

  testing::TemporaryFolder folder_;
  store::JobFolder job_{folder_.path() / "1"};
};

TEST_F(OomKillTest, AKillThatTheKernelCountedIsOutOfMemory) {
  const auto exit = run(7, 8);
  EXPECT_EQ(exit.kind, WorkerExit::Kind::signalled);
  EXPECT_TRUE(exit.out_of_memory);
  EXPECT_TRUE(is_lost(exit));
  EXPECT_EQ(outcome_of(exit).cause, v1::Job::OUT_OF_MEMORY);
  EXPECT_NE(outcome_of(exit).remedy.find("--workers"), std::string::npos);
}

TEST_F(OomKillTest, AnyOtherKillIsNot) {
  const auto exit = run(7, 7);
  EXPECT_FALSE(exit.out_of_memory);
  EXPECT_EQ(outcome_of(exit).cause, v1::Job::WORKER_CRASHED);
}

TEST_F(OomKillTest, TheCountOfThisMachineCanBeRead) { EXPECT_LE(count_oom_kills(), count_oom_kills()); }

}  // namespace
}  // namespace cellcrush::jobs

// What the journal knows of the end of jobs and sweeps: when, how much, and how sweeps leave.
#include <gmock/gmock.h>

#include "error.h"
#include "server/journal_fixture.h"
#include "server/refuses.h"
#include "store/sweep_reader.h"

namespace cellcrush::store {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

class RetentionJournalTest : public JournalTest {
 protected:
  void SetUp() override { reopen_on_clock(); }

  // As a daemon that starts while the machine has been up for so long.
  void reopen_on_clock() {
    reader_.reset();
    journal_.reset();
    journal_.emplace(
        path(), [](std::int64_t) {}, GroupCommit::Committed(), [this] { return std::chrono::seconds(uptime_); });
    reader_.emplace(path());
  }

  Journal::CreatedSweep make_sweep(int jobs) {
    return journal_->create_sweep({}, std::vector<SweepJob>(static_cast<std::size_t>(jobs)), "id", "hash");
  }

  std::int64_t uptime_ = 1000;
};

TEST_F(RetentionJournalTest, ADaemonThatWasKilledIsContinuedFromTheNewestEnd) {
  const auto job = create();
  uptime_ += 50;
  change(job, v1::Job::CANCELLED);
  Database(path()).execute("UPDATE service_clock SET seconds = 0");
  reader_.reset();
  // Without the note that a journal makes when it is closed.
  const Journal other(
      path(), [](std::int64_t) {}, GroupCommit::Committed(), [] { return std::chrono::seconds(5); });
  EXPECT_EQ(other.service_seconds(), 50);
  reader_.emplace(path());
}

TEST_F(RetentionJournalTest, ASweepIsDeletedOnlyWhenAllItsJobsHaveEndedAndNamesThoseThatHaveNot) {
  const auto made = make_sweep(8);
  journal_->cancel_waiting({made.jobs[0]});
  change(made.jobs[1], v1::Job::RUNNING);
  const auto begin = [&] { journal_->begin_sweep_deletion(made.sweep); };
  for (const char* words : {"jobs/2 is RUNNING, jobs/3 is PENDING", "and 2 more. Cancel the sweep, then"})
    EXPECT_THAT(begin, testing::Refuses(ServiceError::Kind::failed_precondition, words));
  EXPECT_THROW(journal_->begin_sweep_deletion(99), ServiceError);
}

TEST_F(RetentionJournalTest, ASweepInDeletionIsHiddenAlsoFromTheNextDaemon) {
  const auto made = make_sweep(3);
  journal_->cancel_waiting(made.jobs);
  journal_->begin_sweep_deletion(made.sweep);
  journal_->delete_ended({made.jobs[0]});
  reopen_on_clock();
  SweepReader sweeps(path());
  EXPECT_FALSE(sweeps.find_sweep(made.sweep));
  EXPECT_THAT(sweeps.list_sweeps(100, 10), IsEmpty());
  EXPECT_THAT(sweeps.sweeps_in_deletion(), ElementsAre(made.sweep));
  EXPECT_THAT(journal_->retry_failed(made.sweep), IsEmpty());
  EXPECT_NE(make_sweep(1).sweep, made.sweep) << "Its request_id is free.";
  journal_->end_sweep_deletion(made.sweep);
  EXPECT_THAT(sweeps.sweeps_in_deletion(), ElementsAre(made.sweep)) << "It has jobs still.";
  EXPECT_THAT(journal_->delete_ended(made.jobs), ElementsAre(made.jobs[1], made.jobs[2]));
  journal_->end_sweep_deletion(made.sweep);
  EXPECT_THAT(sweeps.sweeps_in_deletion(), IsEmpty());
}

}  // namespace
}  // namespace cellcrush::store

#include <gtest/gtest.h>

#include <optional>
#include <vector>

#include "error.h"
#include "jobs/deletion.h"
#include "server/journal_fixture.h"
#include "store/data_folder.h"
#include "store/sweep_reader.h"
#include "store/verification.h"

namespace cellcrush::store {
namespace {

class SweepJournalTest : public JournalTest {
 protected:
  static std::vector<SweepJob> three_jobs() {
    std::vector<SweepJob> out(3);
    for (std::size_t i = 0; i < out.size(); ++i) {
      out[i].job = testing::small_job;
      out[i].values = {50.0 * static_cast<double>(i + 1)};
    }
    return out;
  }
};

TEST_F(SweepJournalTest, ASweepSurvivesReopening) {
  v1::Sweep sweep;
  sweep.add_axes()->set_field("loading.speed_m_per_s");
  sweep.set_max_parallel(2);
  const auto made = journal_->create_sweep(sweep, three_jobs(), "", "");
  change(made.jobs[0], v1::Job::RUNNING);
  reopen();
  SweepReader sweeps(path());
  const auto found = sweeps.find_sweep(made.sweep);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->name(), "sweeps/1");
  EXPECT_EQ(found->axes(0).field(), "loading.speed_m_per_s");
  EXPECT_EQ(found->jobs_size(), 3);
  EXPECT_EQ(found->state_counts().at("RUNNING"), 1);
  EXPECT_EQ(found->state_counts().at("PENDING"), 2);
  EXPECT_GT(found->create_time().seconds(), 0);
  const auto rows = sweeps.rows(made.sweep).rows;
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[2].values(0), 150.0);
  EXPECT_EQ(rows[0].result().state(), v1::Job::RUNNING);
  const auto waiting = reader_->queued_jobs(v1::Job::PENDING);
  ASSERT_EQ(waiting.size(), 2U);
  EXPECT_EQ(waiting[0].job, made.jobs[1]);
  EXPECT_EQ(waiting[0].sweep, made.sweep);
  EXPECT_EQ(waiting[0].max_parallel, 2);
  const auto one = reader_->queued_job(made.jobs[1], v1::Job::PENDING);
  ASSERT_TRUE(one);
  EXPECT_EQ(one->job, made.jobs[1]);
  EXPECT_EQ(one->max_parallel, 2);
  EXPECT_FALSE(reader_->queued_job(made.jobs[0], v1::Job::PENDING)) << "It runs.";
  const auto part = sweeps.rows(made.sweep, 1, {1, 1000});
  ASSERT_EQ(part.rows.size(), 1U);
  EXPECT_EQ(part.rows[0].values(0), 100.0);
  EXPECT_EQ(part.last_point, 2);
  EXPECT_TRUE(part.has_more);
  EXPECT_FALSE(sweeps.rows(made.sweep, 2).has_more);
}

TEST_F(SweepJournalTest, WaitingJobsAreCancelledTogetherAndDeletedOnesLeaveTheSweep) {
  const auto made = journal_->create_sweep({}, three_jobs(), "", "");
  change(made.jobs[1], v1::Job::RUNNING);
  journal_->cancel_waiting(made.jobs);
  EXPECT_EQ(reader_->queued_jobs(v1::Job::CANCELLED).size(), 2U);
  EXPECT_EQ(reader_->queued_jobs(v1::Job::RUNNING).size(), 1U);
  journal_->delete_job(made.jobs[0]);
  EXPECT_EQ(SweepReader(path()).jobs_of(made.sweep), (std::vector<std::int64_t>{made.jobs[1], made.jobs[2]}));
}

class LargeSweepTest : public SweepJournalTest {
 protected:
  static std::vector<SweepJob> jobs(std::size_t count) { return std::vector<SweepJob>(count, three_jobs().front()); }
};

// In one commit all other writers would wait for all of its jobs: 100,000 take 2 to 5 s.
TEST_F(LargeSweepTest, ALargeSweepComesInSeveralCommitsAndIsHiddenUntilTheLast) {
  journal_.reset();
  std::optional<Journal> journal;
  SweepReader* sweeps = nullptr;
  std::vector<bool> hidden;
  journal.emplace(
      path(), [](std::int64_t) {},
      [&](double) {
        if (sweeps == nullptr) return;
        hidden.push_back(journal->is_being_created(1) && !sweeps->find_sweep(1) &&
                         reader_->queued_jobs(v1::Job::PENDING).empty());
      });
  SweepReader reading(path());
  sweeps = &reading;
  const auto made = journal->create_sweep({}, jobs(2 * Journal::kCreatedAtOnce + 1), "id", "hash");
  sweeps = nullptr;
  EXPECT_EQ(hidden, (std::vector<bool>{true, true, true, false}));
  EXPECT_FALSE(journal->is_being_created(made.sweep));
  const auto queued = reader_->queued_jobs(v1::Job::PENDING);
  ASSERT_EQ(queued.size(), made.jobs.size());
  EXPECT_EQ(queued.back().submission, made.jobs.front());
  EXPECT_EQ(reading.jobs_of(made.sweep), made.jobs);
  EXPECT_EQ(journal->create_sweep({}, jobs(2 * Journal::kCreatedAtOnce + 1), "id", "hash").sweep, made.sweep);
}

TEST_F(LargeSweepTest, WhatAnInterruptedCreationLeavesNeverRunsAndIsDeleted) {
  Database(path()).execute(
      "CREATE TRIGGER fail BEFORE INSERT ON sweep_jobs WHEN new.position = 7000 BEGIN SELECT RAISE(ABORT, 'no'); END");
  EXPECT_THROW(journal_->create_sweep({}, jobs(12'000), "id", "hash"), ServiceError);
  Database(path()).execute("DROP TRIGGER fail");
  reopen();
  SweepReader sweeps(path());
  EXPECT_FALSE(sweeps.find_sweep(1));
  EXPECT_TRUE(reader_->queued_jobs(v1::Job::PENDING).empty());
  EXPECT_EQ(sweeps.jobs_of(1).size(), Journal::kCreatedAtOnce);
  const auto again = journal_->create_sweep({}, three_jobs(), "id", "hash");
  EXPECT_TRUE(again.is_new) << "The interrupted request has left no id.";
  const DataFolder folder(folder_.path());
  cellcrush::jobs::Deletion({folder, *journal_, *reader_, sweeps}).finish_sweeps([] { return false; });
  EXPECT_TRUE(sweeps.sweeps_in_deletion().empty());
  EXPECT_TRUE(sweeps.jobs_of(1).empty());
  EXPECT_EQ(reader_->queued_jobs(v1::Job::PENDING).size(), again.jobs.size());
  EXPECT_FALSE(reader_->has_job(1));
}

}  // namespace
}  // namespace cellcrush::store

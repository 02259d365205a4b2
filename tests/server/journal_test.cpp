#include "store/journal.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

#include "error.h"
#include "server/daemon_process.h"
#include "server/held_point.h"
#include "server/journal_fixture.h"
#include "store/job_state.h"

namespace cellcrush::store {
namespace {

TEST_F(JournalTest, SamplesThatNobodyWaitsForShareACommitWithThoseThatSomebodyDoes) {
  const auto job = create();
  const int before = told_;
  for (int i = 1; i <= 10; ++i) {
    add_sample(job, sample(i), std::chrono::minutes(1));
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
  }
  EXPECT_EQ(told_, before) << "Nothing was due.";
  add_sample(job, sample(11), Journal::kSoon);
  for (int i = 0; i < 200 && told_ == before; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  EXPECT_EQ(told_, before + 1);
  EXPECT_EQ(reader_->samples(job).samples.size(), 11U);
  add_sample(job, sample(12), std::chrono::minutes(1));
  reopen();
  EXPECT_EQ(reader_->samples(job).samples.back().step(), 12) << "Closing keeps what is gathered.";
}

TEST_F(JournalTest, AskingForSamplesWaitsForThoseThatAnotherIsMakingDurable) {
  std::atomic<bool> is_armed = false;
  testing::HeldPoint commit;
  journal_.reset();
  reader_.reset();
  journal_.emplace(
      path(), [](std::int64_t) {},
      [&](double) {
        if (is_armed) commit.stand();
      });
  const auto job = create();
  add_sample(job, sample(1), std::chrono::minutes(1));
  is_armed = true;
  std::jthread first([&] { journal_->commit_samples(); });
  const bool is_committing = commit.wait();
  EXPECT_TRUE(is_committing);
  std::atomic<pid_t> thread = 0;
  std::atomic<bool> returned = false;
  std::jthread second([&] {
    thread = gettid();
    thread.notify_one();
    journal_->commit_samples();
    returned = true;
  });
  // It sleeps once it waits for the first one; nothing else makes it sleep.
  thread.wait(0);
  while (!returned && !testing::is_asleep(thread)) std::this_thread::yield();
  EXPECT_FALSE(returned);
  commit.open();
  second.join();
  EXPECT_TRUE(returned);
  first.join();
  journal_.reset();  // its last commit calls the function above
}

TEST_F(JournalTest, SamplesThatAreToldAgainAreThereOnce) {
  const auto job = create();
  for (const int step : {1, 2, 3, 4, 5, 3, 4, 5, 6, 7}) add_sample(job, sample(step), std::chrono::minutes(1));
  Journal other(path(), [](std::int64_t) {});
  // As the daemon counts them; the second time, they are not new.
  for (const std::int64_t count : {7, 5}) {
    other.note_samples(job, count);
    other.commit_samples();
    EXPECT_EQ(reader_->find_job(job)->last_sequence, 8);
  }
  const auto stored = reader_->samples(job).samples;
  ASSERT_EQ(stored.size(), 7U);
  for (std::size_t i = 0; i < stored.size(); ++i) EXPECT_EQ(stored[i].step(), static_cast<std::int64_t>(i) + 1);
}

TEST_F(JournalTest, SamplesThatNobodyCouldReadAreNotCounted) {
  const auto job = create();
  change(job, v1::Job::RUNNING);
  add_sample(job, sample(1), std::chrono::minutes(1));
  std::filesystem::rename(reported_.folder_of(job).reports(), path().parent_path() / "elsewhere");
  change(job, v1::Job::FAILED);
  EXPECT_EQ(reader_->find_job(job)->last_sequence, 3);
  std::filesystem::rename(path().parent_path() / "elsewhere", reported_.folder_of(job).reports());
  journal_->commit_samples();
  EXPECT_EQ(reader_->find_job(job)->last_sequence, 3) << "Nothing follows the end.";
}

TEST_F(JournalTest, WhatIsNewIsAdmittedOnceAndNotMadeWhenItIsRefused) {
  int asked = 0;
  const auto admit = [&asked] { ++asked; };
  const auto refuse = [] { throw ServiceError(ServiceError::Kind::exhausted, "full"); };
  EXPECT_THROW(journal_->create_job({}, "id", "hash", 0, refuse), ServiceError);
  EXPECT_THROW(journal_->create_sweep({}, {SweepJob()}, "id", "hash", refuse), ServiceError);
  EXPECT_TRUE(reader_->list_jobs({}, true, 0, 10).empty());
  EXPECT_TRUE(journal_->create_job({}, "id", "hash", 0, admit).is_new);
  EXPECT_TRUE(journal_->create_sweep({}, {SweepJob()}, "id", "hash", admit).is_new);
  EXPECT_EQ(asked, 2);
  EXPECT_FALSE(journal_->create_job({}, "id", "hash", 0, refuse).is_new) << "What is there needs no room.";
  EXPECT_FALSE(journal_->create_sweep({}, {SweepJob()}, "id", "hash", refuse).is_new);
}

TEST(JobState, OnlyARunSucceedsAndNothingFollowsAnEnd) {
  using Job = v1::Job;
  for (const auto from :
       {Job::PENDING, Job::RUNNING, Job::SUSPENDED, Job::CANCELLING, Job::SUCCEEDED, Job::FAILED, Job::CANCELLED}) {
    const bool is_end = from == Job::SUCCEEDED || from == Job::FAILED || from == Job::CANCELLED;
    EXPECT_EQ(is_terminal(from), is_end);
    EXPECT_EQ(may_follow(from, Job::FAILED), !is_end) << Job::State_Name(from);
    EXPECT_FALSE(may_follow(from, from)) << Job::State_Name(from);
    for (int to = Job::State_MIN; is_end && to <= Job::State_MAX; ++to)
      EXPECT_FALSE(may_follow(from, static_cast<Job::State>(to))) << Job::State_Name(from) << to;
  }
  EXPECT_TRUE(may_follow(Job::PENDING, Job::RUNNING));
  EXPECT_TRUE(may_follow(Job::RUNNING, Job::SUCCEEDED));
  for (const auto from : {Job::PENDING, Job::SUSPENDED}) EXPECT_FALSE(may_follow(from, Job::SUCCEEDED));
}

TEST_F(JournalTest, AChangeThatMayNotBeChangesNothing) {
  const auto job = create();
  EXPECT_THROW(change(job, v1::Job::SUCCEEDED), ServiceError);
  EXPECT_EQ(reader_->find_job(job)->job.state(), v1::Job::PENDING);
  EXPECT_EQ(reader_->find_job(job)->last_sequence, 1);
  EXPECT_THROW(change(job + 1, v1::Job::RUNNING), ServiceError);
  EXPECT_THROW(journal_->delete_job(job), ServiceError) << "It has not ended.";
  change(job, v1::Job::CANCELLED);
  EXPECT_THROW(journal_->begin_again(job, "Because."), ServiceError);
}

TEST_F(JournalTest, AJournalOfAnotherVersionIsRefused) {
  for (const char* version : {"PRAGMA user_version = 10", "PRAGMA user_version = 5"}) {
    reader_.reset();
    journal_.reset();
    Database(path()).execute(version);
    EXPECT_THROW(Journal(path(), [](std::int64_t) {}), ServiceError) << version;
  }
}

}  // namespace
}  // namespace cellcrush::store

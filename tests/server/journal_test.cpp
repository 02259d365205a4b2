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
#include "store/sweep_reader.h"
#include "store/verification.h"

namespace cellcrush::store {
namespace {

TEST_F(JournalTest, AJobSurvivesReopening) {
  const auto job = create();
  change(job, v1::Job::RUNNING);
  add_sample(job, sample(1));
  change(job, v1::Job::SUCCEEDED);
  reopen();
  const auto stored = reader_->find_job(job);
  ASSERT_TRUE(stored);
  EXPECT_EQ(stored->job.name(), "jobs/" + std::to_string(job));
  EXPECT_EQ(stored->job.state(), v1::Job::SUCCEEDED);
  EXPECT_EQ(stored->job.labels().at("who"), "me");
  EXPECT_EQ(stored->job.case_().SerializeAsString(), testing::small_case().SerializeAsString());
  EXPECT_EQ(stored->job.summary().step_count(), 99);
  EXPECT_GT(stored->job.end_time().seconds(), 0);
  EXPECT_GE(stored->job.start_time().seconds(), stored->job.create_time().seconds());
  EXPECT_EQ(stored->last_sequence, 4);
}

TEST_F(JournalTest, EventsCountFromOneWithoutAGapAndStatesComeAfterTheSamplesBeforeThem) {
  const auto job = create();
  change(job, v1::Job::RUNNING);
  for (int i = 1; i <= 250; ++i) add_sample(job, sample(i));
  change(job, v1::Job::FAILED);
  const auto events = reader_->events(job, 0, 1000);
  ASSERT_EQ(events.size(), 253U);
  for (std::size_t i = 0; i < events.size(); ++i) EXPECT_EQ(events[i].sequence(), static_cast<std::int64_t>(i) + 1);
  EXPECT_EQ(events[0].state().state(), v1::Job::PENDING);
  EXPECT_EQ(events[1].state().worker_pid(), 4711);
  for (int i = 1; i <= 250; ++i) EXPECT_EQ(events[static_cast<std::size_t>(i) + 1].sample().step(), i);
  EXPECT_EQ(events.back().state().state(), v1::Job::FAILED);
  EXPECT_EQ(reader_->events(job, 252, 1000).size(), 1U);
  EXPECT_EQ(reader_->samples(job).samples.size(), 250U);
}

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
  EXPECT_EQ(reader_->last_sampled_step(job), 12) << "Closing keeps what is gathered.";
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

TEST_F(JournalTest, SamplesAreReadInPartsThatMeet) {
  const auto job = create();
  change(job, v1::Job::RUNNING);
  for (int i = 1; i <= 10; ++i) add_sample(job, sample(i));
  change(job, v1::Job::FAILED);
  std::vector<std::int64_t> steps;
  std::vector<std::size_t> sizes;
  StoredSamples part;
  do {
    part = reader_->samples(job, part.last_sequence, {4, 1000});
    for (const auto& one : part.samples) steps.push_back(one.step());
    sizes.push_back(part.samples.size());
  } while (part.has_more);
  EXPECT_EQ(steps, (std::vector<std::int64_t>{1, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
  EXPECT_EQ(sizes, (std::vector<std::size_t>{4, 4, 2}));
  EXPECT_EQ(reader_->samples(job, 0, {1000, 1}).samples.size(), 1U) << "One always, however large.";
  EXPECT_EQ(reader_->samples(job, 0, {1000, sample(1).ByteSizeLong() * 3}).samples.size(), 3U);
  EXPECT_TRUE(reader_->samples(job, 12).samples.empty());
  EXPECT_FALSE(reader_->samples(job, 0, {10, 1000}).has_more) << "The end of the list is seen.";
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

TEST_F(JournalTest, ARequestIdMakesOneJobAndNoOtherRequestMayUseIt) {
  const auto first = create("id", "hash");
  reopen();
  EXPECT_EQ(create("id", "hash"), first);
  EXPECT_NE(create("other", "hash"), first);
  EXPECT_EQ(reader_->list_jobs({}, true, 0, 10).size(), 2U);
  try {
    create("id", "another hash");
    FAIL() << "The id was taken for another request.";
  } catch (const ServiceError& error) {
    EXPECT_EQ(error.kind(), ServiceError::Kind::already_exists);
  }
}

TEST_F(JournalTest, AChangeThatMayNotBeChangesNothing) {
  const auto job = create();
  EXPECT_THROW(change(job, v1::Job::SUCCEEDED), ServiceError);
  EXPECT_EQ(reader_->find_job(job)->job.state(), v1::Job::PENDING);
  EXPECT_EQ(reader_->find_job(job)->last_sequence, 1);
  EXPECT_THROW(change(job + 1, v1::Job::RUNNING), ServiceError);
}

TEST_F(JournalTest, AFilterLooksThroughMoreJobsThanAPageHolds) {
  for (int i = 0; i < 500; ++i) create();
  change(3, v1::Job::RUNNING);
  JobFilter filter;
  filter.states = {v1::Job::RUNNING};
  filter.labels = {{"who", "me"}};
  const auto listed = reader_->list_jobs(filter, true, 0, 10);
  ASSERT_EQ(listed.size(), 1U);
  EXPECT_EQ(listed[0].number, 3);
  filter.labels = {{"who", "you"}};
  EXPECT_TRUE(reader_->list_jobs(filter, true, 0, 10).empty());
  filter = {};
  filter.titles = {"FEW"};
  EXPECT_EQ(reader_->list_jobs(filter, false, 450, 100).size(), 50U);
}

TEST_F(JournalTest, ADeletedJobLeavesNothingButTheNoteOnItsFolder) {
  const auto job = create("id", "hash");
  EXPECT_THROW(journal_->delete_job(job), ServiceError);
  change(job, v1::Job::CANCELLED);
  journal_->set_mesh(job, {});
  journal_->delete_job(job);
  EXPECT_FALSE(reader_->has_job(job));
  EXPECT_FALSE(reader_->mesh(job));
  EXPECT_TRUE(reader_->events(job, 0, 10).empty());
  EXPECT_THROW(journal_->delete_job(job), ServiceError);
  reopen();
  EXPECT_EQ(reader_->deleted_jobs(), std::vector<std::int64_t>{job});
  journal_->note_folders_removed({job});
  EXPECT_TRUE(reader_->deleted_jobs().empty());
  EXPECT_GT(create("id", "hash"), job) << "Numbers are not used again.";
}

TEST_F(JournalTest, AJournalOfAnotherVersionIsRefused) {
  for (const char* version : {"PRAGMA user_version = 8", "PRAGMA user_version = 5"}) {
    reader_.reset();
    journal_.reset();
    Database(path()).execute(version);
    EXPECT_THROW(Journal(path(), [](std::int64_t) {}), ServiceError) << version;
  }
}

TEST_F(JournalTest, AnExecutorIsKeptWithItsJob) {
  v1::Job job;
  *job.mutable_case_() = testing::small_case();
  job.set_executor("slurm/test");
  const auto elsewhere = journal_->create_job(job, "", "").job;
  const auto here = create();
  reopen();
  EXPECT_EQ(reader_->executor_of(elsewhere), "slurm/test");
  EXPECT_EQ(reader_->executor_of(here), kLocalExecutor);
  EXPECT_FALSE(reader_->executor_of(99));
  EXPECT_EQ(reader_->find_job(elsewhere)->job.executor(), "slurm/test");
  EXPECT_EQ(reader_->find_job(here)->job.executor(), kLocalExecutor);
  const auto queued = reader_->queued_jobs(v1::Job::PENDING, "slurm/test");
  ASSERT_EQ(queued.size(), 1U);
  EXPECT_EQ(queued[0].job, elsewhere);
  EXPECT_EQ(queued[0].executor, "slurm/test");
  ASSERT_EQ(reader_->queued_jobs(v1::Job::PENDING, kLocalExecutor).size(), 1U);
  EXPECT_EQ(reader_->queued_jobs(v1::Job::PENDING).size(), 2U);
  EXPECT_EQ(reader_->executors_in_use(), (std::vector<std::string>{kLocalExecutor, "slurm/test"}));
  change(elsewhere, v1::Job::CANCELLED);
  EXPECT_EQ(reader_->executors_in_use(), std::vector<std::string>{kLocalExecutor});
}

}  // namespace
}  // namespace cellcrush::store

// A job that is begun again from step 0, and the epochs of a journal, in the store.
#include <gmock/gmock.h>

#include "error.h"
#include "server/journal_fixture.h"

namespace cellcrush::store {
namespace {

using ::testing::HasSubstr;

class BeginAgainTest : public JournalTest {
 protected:
  // A job with a mesh and the samples of steps 0, 10, 20, which runs. Its events: two states and three samples.
  std::int64_t running() {
    const auto job = create();
    change(job, v1::Job::RUNNING);
    journal_->set_mesh(job, v1::Mesh());
    for (int step = 0; step <= 20; step += 10) add_sample(job, sample(step));
    journal_->commit_samples();
    return job;
  }
};

TEST_F(BeginAgainTest, SamplesAndMeshGoAndTheNumbersCountOn) {
  const auto job = running();
  add_sample(job, sample(30));  // gathered and not durable
  journal_->begin_again(job, "Because.");
  const auto stored = reader_->find_job(job);
  EXPECT_EQ(stored->job.state(), v1::Job::PENDING);
  EXPECT_EQ(stored->job.cause_message(), "Because.");
  EXPECT_EQ(stored->job.worker_pid(), 0);
  EXPECT_EQ(stored->job.attempt(), 1);
  EXPECT_EQ(stored->last_sequence, 6);
  EXPECT_EQ(stored->job.begun_again_sequence(), 6);
  EXPECT_FALSE(reader_->mesh(job));
  EXPECT_EQ(reader_->last_sampled_step(job), -1);
  reported_.discard(job);
  journal_->commit_samples();
  EXPECT_TRUE(reader_->samples(job).samples.empty());
  change(job, v1::Job::RUNNING);
  add_sample(job, sample(0));
  journal_->commit_samples();
  const auto events = reader_->events(job, 0, 100);
  ASSERT_EQ(events.size(), 5U);
  EXPECT_EQ(events[2].sequence(), 6);
  EXPECT_EQ(events[2].state().begun_again_sequence(), 6);
  EXPECT_EQ(events[4].sequence(), 8);
  EXPECT_EQ(events[4].sample().step(), 0) << "Its steps begin at 0 again.";
  // A watcher who has had the samples is sent what comes behind them.
  EXPECT_EQ(reader_->events(job, 5, 100).size(), 3U);
}

TEST_F(BeginAgainTest, ASuspendedJobStaysSoAndOneThatHasEndedIsRefused) {
  const auto suspended = running();
  change(suspended, v1::Job::SUSPENDED);
  journal_->begin_again(suspended, "Because.");
  EXPECT_EQ(reader_->find_job(suspended)->job.state(), v1::Job::SUSPENDED);
  const auto ended = running();
  change(ended, v1::Job::SUCCEEDED);
  EXPECT_THROW(journal_->begin_again(ended, "Because."), ServiceError);
  EXPECT_EQ(reader_->samples(ended).samples.size(), 3U);
  EXPECT_THROW(journal_->begin_again(99, "Because."), ServiceError);
}

TEST_F(BeginAgainTest, AnEpochOutlivesTheDaemonAndEndsWithARestore) {
  const Epoch first = journal_->epoch();
  EXPECT_EQ(first.id.size(), 16U);
  reopen();
  EXPECT_EQ(journal_->epoch().id, first.id);
  EXPECT_EQ(reader_->epoch().id, first.id);
  EXPECT_TRUE(first.admits(first.id));
  EXPECT_TRUE(first.admits("")) << "What an earlier version left.";
  {
    Database database(path());
    begin_epoch(database, "2026-11-23T09:15:02Z");
  }
  reopen();
  EXPECT_NE(journal_->epoch().id, first.id);
  EXPECT_FALSE(journal_->epoch().admits(first.id));
  EXPECT_FALSE(journal_->epoch().admits(""));
  EXPECT_THAT(journal_->epoch().of_before(), HasSubstr("2026-11-23T09:15:02Z"));
}

}  // namespace
}  // namespace cellcrush::store

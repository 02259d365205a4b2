#include "store/change_reader.h"

#include <gmock/gmock.h>

#include "server/journal_fixture.h"

namespace cellcrush::store {
namespace {

using ::testing::ElementsAre;

class ChangeReaderTest : public JournalTest {
 protected:
  static std::string text_of(const Change& change) {
    const char* const kinds[] = {"?", "state", "deleted", "sweep", "sweep deleted"};
    return std::string(kinds[static_cast<int>(change.kind)]) + " " + std::to_string(change.resource) +
           (change.sequence > 0 ? " " + std::to_string(change.sequence) : "");
  }
  std::vector<std::string> after(std::int64_t change) {
    std::vector<std::string> out;
    for (const auto& each : ChangeReader(path()).after(change, 100)) out.push_back(text_of(each));
    return out;
  }
};

TEST_F(ChangeReaderTest, EveryChangeOfAJobOrSweepIsNotedInTheOrderOfTheCommits) {
  const auto first = create();
  change(first, v1::Job::RUNNING);
  SweepJob member;
  member.job = testing::small_job;
  const auto sweep = journal_->create_sweep({}, {member, member}, "", "");
  v1::Sample sample;
  sample.set_step(1);
  add_sample(first, sample);
  journal_->commit_samples();
  change(first, v1::Job::FAILED);
  journal_->delete_job(first);
  change(sweep.jobs[0], v1::Job::RUNNING);
  change(sweep.jobs[0], v1::Job::FAILED);
  const auto retried = journal_->retry_failed(sweep.sweep);
  EXPECT_THAT(after(0), ElementsAre("state 1 1", "state 1 2", "sweep 1", "state 2 1", "state 3 1", "state 1 4",
                                    "deleted 1", "state 2 2", "state 2 3", "state 4 1", "sweep 1"))
      << "A sample is no change of state.";
  EXPECT_EQ(retried.at(0).job, 4);
  journal_->cancel_waiting({sweep.jobs[1], 4});
  const auto last = ChangeReader(path()).last();
  journal_->begin_sweep_deletion(sweep.sweep);
  EXPECT_THAT(after(last), ElementsAre("sweep deleted 1"));
}

TEST_F(ChangeReaderTest, OldChangesAreForgottenAndThatIsKnown) {
  ChangeReader changes(path());
  EXPECT_EQ(changes.last(), 0);
  EXPECT_TRUE(changes.has_all_after(0)) << "An empty journal has all.";
  create();
  EXPECT_EQ(changes.last(), 1);
  EXPECT_TRUE(changes.has_all_after(0));
  {
    Database database(path());
    database.execute(
        "WITH RECURSIVE more(n) AS (SELECT 1 UNION ALL SELECT n + "
        "1 FROM more WHERE n < 102500) "
        "INSERT INTO changes (kind, resource, sequence) SELECT 2, "
        "n, 0 FROM more");
  }
  EXPECT_EQ(changes.last(), 102501);
  EXPECT_FALSE(changes.has_all_after(0));
  EXPECT_FALSE(changes.has_all_after(1999));
  EXPECT_TRUE(changes.has_all_after(2000));
  EXPECT_EQ(changes.after(2000, 1).at(0).number, 2001);
}

TEST_F(ChangeReaderTest, ChangesAreLookedForOncePerStamp) {
  const auto job = create();
  ChangeReader changes(path());
  const auto last = changes.last();
  EXPECT_FALSE(changes.has_after(last, {1, 0}));
  change(job, v1::Job::RUNNING);
  EXPECT_FALSE(changes.has_after(last, {1, 0})) << "Nobody has announced it.";
  EXPECT_TRUE(changes.has_after(last, {2, 0}));
  EXPECT_FALSE(changes.has_after(last + 1, {2, 0}));
  change(job, v1::Job::CANCELLING);
  EXPECT_TRUE(changes.has_after(last + 1, {2, 1})) << "Time has passed.";
}

}  // namespace
}  // namespace cellcrush::store

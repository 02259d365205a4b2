// How large a journal stays.
#include "store/journal_upkeep.h"

#include <gmock/gmock.h>

#include <chrono>
#include <thread>

#include "error.h"
#include "server/journal_fixture.h"

namespace cellcrush::store {
namespace {

using ::testing::HasSubstr;

constexpr std::uintmax_t kMebibyte = 1024 * 1024;

class JournalUpkeepTest : public JournalTest {
 protected:
  [[nodiscard]] std::uintmax_t size(const std::string& suffix = "") const {
    std::error_code none;
    const auto out = std::filesystem::file_size(path().string() + suffix, none);
    return none ? 0 : out;
  }

  // Large samples, committed in pieces as a running daemon does.
  void fill(std::int64_t job, int samples) {
    v1::Sample large;
    for (int i = 0; i < 1000; ++i) large.add_watched()->set_ux_mm(i + 0.5);
    for (int step = 1; step <= samples; ++step) {
      large.set_step(step);
      journal_->append_sample(job, large);
      if (step % 100 == 0) journal_->commit_samples();
    }
    journal_->commit_samples();
  }
};

TEST_F(JournalUpkeepTest, AfterABurstAndItsDeletionJournalAndWalAreSmallAgain) {
  constexpr std::uintmax_t kBound = 64 * kMebibyte;
  const auto kept = create();
  std::uintmax_t most = 0;
  for (int i = 0; i < 3; ++i) {
    const auto job = create();
    change(job, v1::Job::RUNNING);
    fill(job, 4000);
    change(job, v1::Job::SUCCEEDED);
    most = std::max(most, size() + size("-wal"));
    journal_->delete_job(job);
    most = std::max(most, size() + size("-wal"));
  }
  for (int i = 0; i < 300 && size() + size("-wal") >= kBound; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  EXPECT_GT(most, kBound) << "The burst was none.";
  EXPECT_LT(size() + size("-wal"), kBound) << size() << " and " << size("-wal");
  EXPECT_EQ(reader_->find_job(kept)->job.state(), v1::Job::PENDING);
  Database database(path());
  Statement check(database, "PRAGMA integrity_check");
  ASSERT_TRUE(check.step());
  EXPECT_EQ(check.bytes(0), "ok");
}

TEST_F(JournalUpkeepTest, AJournalOfAnEarlierVersionCanGiveBackAfterItsFirstStart) {
  reader_.reset();
  journal_.reset();
  {
    Database database(path());
    database.execute("PRAGMA auto_vacuum=NONE; VACUUM;");
  }
  reopen();
  Database database(path());
  Statement mode(database, "PRAGMA auto_vacuum");
  ASSERT_TRUE(mode.step());
  EXPECT_EQ(mode.integer(0), 2);
}

}  // namespace
}  // namespace cellcrush::store

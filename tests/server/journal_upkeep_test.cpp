// How large a journal stays.
#include "store/journal_upkeep.h"

#include <gmock/gmock.h>

#include <chrono>
#include <thread>

#include "error.h"
#include "server/journal_fixture.h"
#include "server/refuses.h"

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

  std::int64_t create_with_large_mesh() {
    const auto job = create();
    v1::Mesh mesh;
    mesh.mutable_position_mm()->Resize(8 * kMebibyte / sizeof(float), 0.5F);
    mesh.set_length_mm(static_cast<double>(job));  // otherwise all have the same one
    journal_->set_mesh(job, mesh);
    return job;
  }
};

TEST_F(JournalUpkeepTest, AfterABurstAndItsDeletionJournalAndWalAreSmallAgain) {
  constexpr std::uintmax_t kBound = 64 * kMebibyte;
  const auto kept = create();
  std::uintmax_t most = 0;
  for (int i = 0; i < 2; ++i) {
    std::vector<std::int64_t> jobs;
    for (int k = 0; k < 10; ++k) jobs.push_back(create_with_large_mesh());
    most = std::max(most, size() + size("-wal"));
    journal_->delete_ended(journal_->cancel_waiting(jobs));
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

TEST_F(JournalUpkeepTest, AFileIsDamagedWhereItLacksATableAndNotForAnyOtherError) {
  Database database(path().string() + ".other");
  EXPECT_THAT([&] { database.execute("SELECT * FROM jobs"); },
              testing::Refuses(ServiceError::Kind::data_loss, "is damaged (no such table: jobs)"));
  database.execute("BEGIN");
  EXPECT_THAT([&] { database.execute("BEGIN"); },
              testing::Refuses(ServiceError::Kind::internal, "within a transaction"));
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

// What a running daemon lacks for a while: descriptors, its folder, its journal, pages of the journal.
#include <gmock/gmock.h>
#include <sys/mount.h>
#include <sys/resource.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <thread>

#include "faults/fault_fixture.h"
#include "server/small_case.h"
#include "store/sqlite.h"

namespace cellcrush::testing {
namespace {

using ::testing::HasSubstr;

class ShortageTest : public FaultFixture {
 protected:
  void TearDown() override {
    if (mounted_) umount2(jobs_folder().c_str(), MNT_DETACH);
    FaultFixture::TearDown();
  }

  [[nodiscard]] std::filesystem::path jobs_folder() const { return data_folder() / "jobs"; }

  // The causes for which the queue is held.
  static std::string held_for(const Client& client) {
    std::string out;
    const auto queue = client.queue();
    for (const auto& hold : queue.holds()) out += hold.cause() + " ";
    return out;
  }

  static bool wait_until_held_for(const Client& client, const std::string& cause) {
    return wait_until([&] { return held_for(client).find(cause) != std::string::npos; }, std::chrono::seconds(30));
  }

  static std::map<v1::Job::State, int> count_states(Client& client) {
    std::map<v1::Job::State, int> out;
    for (const auto& [name, job] : all_jobs(client)) ++out[job.state()];
    return out;
  }

  static void expect_all_to_succeed(Client& client, int count) {
    EXPECT_TRUE(wait_until([&] { return count_states(client)[v1::Job::SUCCEEDED] == count; }, std::chrono::minutes(2)));
  }

  void limit_descriptors(rlim_t limit) const {
    rlimit now{};
    ASSERT_EQ(prlimit(daemon_->number(), RLIMIT_NOFILE, nullptr, &now), 0);
    now.rlim_cur = limit;
    ASSERT_EQ(prlimit(daemon_->number(), RLIMIT_NOFILE, &now, nullptr), 0);
  }

  // Sets the number of the next page in each page that holds nothing but the title of a large case.
  void damage_overflow_pages() const {
    constexpr std::size_t kPage = 4096;
    std::fstream file(journal(), std::ios::in | std::ios::out | std::ios::binary);
    std::string page(kPage, '\0');
    int damaged = 0;
    for (std::streamoff at = 0; file.seekg(at).read(page.data(), kPage); at += kPage) {
      if (page.find_first_not_of('n', 4) != std::string::npos) continue;
      file.seekp(at).write("\xff\xff\xff\xff", 4);
      ++damaged;
    }
    ASSERT_GT(damaged, 1);
  }

  bool mounted_ = false;
};

TEST_F(ShortageTest, WithoutDescriptorsTheQueueIsHeldAndNoJobFails) {
  const int count = rounds(30, 500);
  fill_journal(data_folder(), count, tiny_case());
  start_daemon({"--workers", "2"});
  auto client = this->client();
  ASSERT_FALSE(all_jobs(client).empty()) << "The connection is there.";
  limit_descriptors(4);
  ASSERT_TRUE(wait_until_held_for(client, "descriptors"));
  std::this_thread::sleep_for(std::chrono::milliseconds(rounds(500, 2000)));
  EXPECT_EQ(count_states(client)[v1::Job::FAILED], 0);
  EXPECT_GT(count_states(client)[v1::Job::PENDING], 0);
  EXPECT_FALSE(is_serving(client, "cellcrush.queue"));
  limit_descriptors(1024);
  expect_all_to_succeed(client, count);
  EXPECT_EQ(held_for(client), "");
  EXPECT_TRUE(is_serving(client, "cellcrush.queue"));
  const std::string log = stop_daemon();
  EXPECT_THAT(log, HasSubstr("The queue is held"));
  EXPECT_THAT(log, HasSubstr("LimitNOFILE"));
}

TEST_F(ShortageTest, WhileTheFolderOfJobsCannotBeWrittenTheQueueIsHeldAndNoJobFails) {
  fill_journal(data_folder(), 10, tiny_case());
  ASSERT_TRUE(std::filesystem::exists(jobs_folder()));
  if (mount(jobs_folder().c_str(), jobs_folder().c_str(), nullptr, MS_BIND, nullptr) != 0)
    GTEST_SKIP() << "No folder can be mounted here: " << std::strerror(errno);
  mounted_ = true;
  const auto remount = [this](unsigned long how) {
    return mount(nullptr, jobs_folder().c_str(), nullptr, MS_REMOUNT | MS_BIND | how, nullptr);
  };
  ASSERT_EQ(remount(MS_RDONLY), 0) << std::strerror(errno);
  start_daemon({"--workers", "2"});
  auto client = this->client();
  ASSERT_TRUE(wait_until_held_for(client, "data_folder"));
  EXPECT_EQ(count_states(client)[v1::Job::PENDING], 10);
  ASSERT_EQ(remount(0), 0) << std::strerror(errno);
  expect_all_to_succeed(client, 10);
}

TEST_F(ShortageTest, AJournalThatAnotherProgramLocksForLongFailsNoJob) {
  const int count = 10;
  fill_journal(data_folder(), count, tiny_case());
  start_daemon({"--workers", "2"});
  auto client = this->client();
  {
    store::Database other(journal());
    store::Transaction lock(other);
    ASSERT_TRUE(wait_until_held_for(client, "journal")) << "SQLite waits for 10 s.";
  }
  expect_all_to_succeed(client, count);
  EXPECT_EQ(held_for(client), "");
}

// The chain of pages that holds a large case is cut in its middle, behind the daemon's back.
TEST_F(ShortageTest, ADamagedPageThatASlotReadsCostsOneJobAndTheDaemonGoesOn) {
  auto large = tiny_case();
  large.set_title(std::string(20'000, 'n'));
  fill_journal(data_folder(), 3, tiny_case());
  {
    store::Database database(journal());
    store::Statement replace(database,
                             "UPDATE jobs SET submitted_case = ?2, case_checksum = row_checksum(?2) WHERE number = ?1");
    replace.bind(1, 1).bind_blob(2, endless_case().SerializeAsString()).run();
    replace.bind(1, 2).bind_blob(2, large.SerializeAsString()).run();
    database.execute("PRAGMA wal_checkpoint(TRUNCATE)");
  }
  start_daemon({"--workers", "1"});
  auto client = this->client();
  ASSERT_TRUE(client.wait_for_state("jobs/1", v1::Job::RUNNING));
  damage_overflow_pages();
  ASSERT_TRUE(client.cancel("jobs/1").ok());
  EXPECT_TRUE(client.wait_for_state("jobs/3", v1::Job::SUCCEEDED)) << client.get("jobs/3").cause_message();
  EXPECT_TRUE(client.wait_for_state("jobs/1", v1::Job::CANCELLED));
  EXPECT_EQ(held_for(client), "") << "One job's damage holds nobody.";
  EXPECT_THAT(stop_daemon(), HasSubstr("jobs/2"));
}

}  // namespace
}  // namespace cellcrush::testing

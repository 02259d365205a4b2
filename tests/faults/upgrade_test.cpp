// A daemon of today on the data of the three versions before (tests/server/data): nothing is lost.
#include <gmock/gmock.h>

#include <cstdlib>
#include <iostream>

#include "faults/fault_fixture.h"
#include "server/job_numbers.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"
#include "server/watch_contract.h"
#include "store/backup.h"
#include "store/journal_reader.h"
#include "store/sqlite.h"
#include "store/verification.h"

namespace cellcrush::testing {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class UpgradeTest : public FaultFixture {
 protected:
  void unpack(int version) {
    std::filesystem::create_directories(data_folder());
    const std::string command = std::string("tar -C ") + data_folder().string() + " -xzf " + SERVER_TEST_DATA +
                                "/journal-" + std::to_string(version) + ".tar.gz";
    ASSERT_EQ(std::system(command.c_str()), 0);
    std::filesystem::permissions(data_folder(), std::filesystem::perms::owner_all);
  }

  void serve(int version) {
    ASSERT_NO_FATAL_FAILURE(unpack(version));
    ASSERT_NO_FATAL_FAILURE(start_daemon({"--workers", "1"}));
    auto client = this->client();
    const auto jobs = all_jobs(client);
    EXPECT_EQ(jobs.size(), 7U);
    EXPECT_EQ(jobs.at("jobs/1").state(), v1::Job::SUCCEEDED);
    EXPECT_EQ(jobs.at("jobs/2").state(), v1::Job::CANCELLED);
    EXPECT_EQ(client.history("jobs/1").size(), 21U);
    for (const char* ended : {"jobs/1", "jobs/2"}) {
      grpc::Status status;
      EXPECT_GT(client.download(ended, 0, status).size(), 1000U);
      EXPECT_TRUE(status.ok()) << status.error_message();
    }
    EXPECT_EQ(get_sweep(client, "sweeps/1").jobs_size(), 2);
    stop_daemon();
    EXPECT_THAT(store::verify_folder(data_folder()).problems, IsEmpty());
  }
};

// Damage afterwards is found, so the rows were sealed.
TEST_F(UpgradeTest, AJournalOfVersion7IsServedAndSealed) {
  ASSERT_NO_FATAL_FAILURE(serve(7));
  store::Database damaged(journal());
  damaged.execute("DROP TRIGGER seal_changed_jobs; UPDATE jobs SET priority = 5 WHERE number = 2");
  EXPECT_THAT(store::verify_folder(data_folder()).problems, ElementsAre(HasSubstr("jobs/2")));
}

TEST_F(UpgradeTest, AJournalOfVersion8IsServed) { ASSERT_NO_FATAL_FAILURE(serve(8)); }

TEST_F(UpgradeTest, AllJobsOfVersion6AreServedOrRunToTheirEnd) {
  ASSERT_NO_FATAL_FAILURE(unpack(6));
  std::int64_t last_before = 0;
  {
    store::Database before(journal(), store::Database::Access::read_only);
    store::Statement version(before, "PRAGMA user_version");
    ASSERT_TRUE(version.step());
    ASSERT_EQ(version.integer(0), 6);
    store::Statement last(before, "SELECT last_sequence FROM jobs WHERE number = 3");
    ASSERT_TRUE(last.step());
    last_before = last.integer(0);
    ASSERT_GT(last_before, 3) << "It had samples.";
  }
  start_daemon({"--workers", "2"});
  auto client = this->client();
  EXPECT_EQ(all_jobs(client).size(), 7U);
  EXPECT_EQ(client.get("jobs/1").state(), v1::Job::SUCCEEDED);
  EXPECT_EQ(client.get("jobs/1").executor(), "local");
  EXPECT_EQ(client.history("jobs/1").size(), 21U);
  EXPECT_EQ(client.get("jobs/2").state(), v1::Job::CANCELLED);
  EXPECT_TRUE(client.annotate("jobs/2", "of before").ok());
  EXPECT_EQ(client.get("jobs/2").note(), "of before");
  for (const char* ended : {"jobs/1", "jobs/2"}) {
    grpc::Status status;
    EXPECT_GT(client.download(ended, 0, status).size(), 1000U);
    EXPECT_TRUE(status.ok()) << status.error_message();
    EXPECT_FALSE(numbers_of(client, data_folder(), ended).history.empty());
  }

  // The running one begins again, and a watcher who had its samples is told.
  WatchContract contract(last_before);
  const auto watched =
      client.watch("jobs/3", last_before, false, [&](const v1::JobEvent& event) { contract.see(event); });
  contract.end(watched.status);
  EXPECT_THAT(contract.broken(), IsEmpty());
  const auto third = client.get("jobs/3");
  EXPECT_EQ(third.state(), v1::Job::SUCCEEDED) << third.cause_message();
  EXPECT_GT(third.begun_again_sequence(), last_before);
  EXPECT_EQ(client.history("jobs/3").size(), 101U) << "Those of this solver, none twice.";
  const auto again = std::find_if(watched.events.begin(), watched.events.end(), [](const v1::JobEvent& event) {
    return event.has_state() && event.state().begun_again_sequence() == event.sequence();
  });
  ASSERT_NE(again, watched.events.end());
  EXPECT_THAT(again->state().cause_message(),
              AllOf(HasSubstr("Restarted from step 0"), HasSubstr("by solver 0.1.0+"), HasSubstr("this is solver")));

  EXPECT_EQ(client.get("jobs/4").state(), v1::Job::SUSPENDED);
  ASSERT_TRUE(client.resume("jobs/4").ok());
  for (const char* job : {"jobs/4", "jobs/5", "jobs/6", "jobs/7"}) {
    ASSERT_TRUE(client.watch(job).status.ok());
    EXPECT_EQ(client.get(job).state(), v1::Job::SUCCEEDED) << job << ": " << client.get(job).cause_message();
  }
  EXPECT_EQ(get_sweep(client, "sweeps/1").jobs_size(), 2);
  EXPECT_TRUE(numbers_of(client, data_folder(), "jobs/3") == numbers_of(client, data_folder(), "jobs/4"));
  stop_daemon();
  EXPECT_THAT(store::verify_folder(data_folder()).problems, IsEmpty());

  // What it had in the journal is in its backups.
  const auto backup = data_folder().parent_path() / "backup";
  const auto restored = data_folder().parent_path() / "restored";
  EXPECT_THAT(store::take_backup(data_folder(), backup).lost, IsEmpty());
  store::restore_backup(backup, restored);
  store::JournalReader reader(restored / "journal.sqlite");
  EXPECT_EQ(reader.samples(1).samples.size(), 21U);
  EXPECT_EQ(reader.samples(2).samples.size(), 17U);
}

}  // namespace
}  // namespace cellcrush::testing

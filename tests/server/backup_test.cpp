// Backups, what is found wrong in them, and what a restore makes of them, with the programs a user has.
#include "store/backup.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>

#include "error.h"
#include "server/daemon_fixture.h"
#include "server/daemon_process.h"
#include "server/job_numbers.h"
#include "server/small_case.h"
#include "server/sweep_requests.h"
#include "store/sqlite.h"
#include "store/verification.h"

namespace cellcrush::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::UnorderedElementsAre;

class BackupTest : public DaemonFixture {
 protected:
  [[nodiscard]] std::filesystem::path backup() const { return folder_.path() / "backup"; }
  [[nodiscard]] std::filesystem::path restored() const { return folder_.path() / "restored"; }

  void restart_on_the_restored() {
    auto options = default_options();
    options.data_folder = restored();
    start(options);
  }

  // Two jobs that have ended, and a sweep of two.
  void make_ended_jobs(Client& client) {
    for (int i = 0; i < 2; ++i) {
      const std::string job = client.create(tiny_case());
      ASSERT_TRUE(client.wait_for_state(job, v1::Job::SUCCEEDED));
    }
    const auto sweep = create(client, sweep_of(tiny_case(), kSpeed, {50.0, 80.0}));
    ASSERT_TRUE(wait_for_count(client, sweep.name(), v1::Job::SUCCEEDED, 2));
  }

  static std::string refusal(const std::function<void()>& call) {
    try {
      call();
    } catch (const ServiceError& error) {
      return error.what();
    }
    return "not refused";
  }
};

TEST_F(BackupTest, WhatHadEndedIsRestoredByteForByteAndWhatRanOrWaitedRunsToItsEnd) {
  auto client = this->client();
  make_ended_jobs(client);
  grpc::Status status;
  const std::string bytes = client.download("jobs/1", 0, status);
  const auto history = client.history("jobs/1");
  const std::string first = client.create(case_of_seconds());
  const std::string second = client.create(case_of_seconds());
  const std::string waiting = client.create(tiny_case());
  wait_for_samples(client, first, 10);
  store::take_backup(data_folder(), backup());
  EXPECT_TRUE(std::filesystem::exists(backup() / "MANIFEST"));
  const auto found = store::verify_folder(backup());
  EXPECT_THAT(found.problems, IsEmpty());
  EXPECT_TRUE(found.is_backup);
  EXPECT_EQ(found.jobs, 7);
  EXPECT_EQ(found.results, 4);
  ASSERT_TRUE(client.watch(first).status.ok()) << "The daemon it was taken of was not disturbed.";

  store::restore_backup(backup(), restored());
  EXPECT_THAT(store::verify_folder(restored()).problems, IsEmpty());
  restart_on_the_restored();
  auto next = this->client();
  EXPECT_EQ(next.download("jobs/1", 0, status), bytes);
  ASSERT_EQ(next.history("jobs/1").size(), history.size());
  for (std::size_t i = 0; i < history.size(); ++i)
    EXPECT_EQ(next.history("jobs/1")[i].SerializeAsString(), history[i].SerializeAsString());
  EXPECT_EQ(get_sweep(next, "sweeps/1").jobs_size(), 2);
  EXPECT_GT(next.get(first).begun_again_sequence(), 0);
  for (const auto& job : {first, second, waiting}) {
    ASSERT_TRUE(next.watch(job).status.ok());
    EXPECT_EQ(next.get(job).state(), v1::Job::SUCCEEDED) << next.get(job).cause_message();
  }
  EXPECT_EQ(next.history(first).size(), 200U) << "None twice, none of before.";
  EXPECT_TRUE(numbers_of(next, restored(), first) == numbers_of(next, restored(), second));
}

TEST_F(BackupTest, TheRestoredDaemonRefusesWhatIsOfBeforeByName) {
  auto client = this->client();
  make_ended_jobs(client);
  std::string epoch;
  const auto watched = client.watch("jobs/1");
  epoch = watched.events.front().snapshot().epoch();
  EXPECT_FALSE(epoch.empty());
  const auto token = watch_sweep(client, "sweeps/1").responses.back().resume_token();
  const auto without_epoch = token.substr(token.find('@') + 1);
  for (const auto& each : {token, without_epoch}) EXPECT_TRUE(watch_sweep(client, "sweeps/1", each).status.ok());
  store::take_backup(data_folder(), backup());
  store::restore_backup(backup(), restored());
  restart_on_the_restored();
  auto next = this->client();
  const auto refused = watch_sweep(next, "sweeps/1", token).status;
  EXPECT_EQ(refused.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_THAT(refused.error_message(), HasSubstr("before the restore of 20"));
  // As of a version that had no epochs.
  EXPECT_EQ(watch_sweep(next, "sweeps/1", without_epoch).status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  v1::WatchJobRequest request;
  request.set_name("jobs/1");
  request.set_after_sequence(3);
  request.set_epoch(epoch);
  const auto context = bounded_context();
  const auto reader = next.jobs->WatchJob(context.get(), request);
  v1::JobEvent event;
  EXPECT_FALSE(reader->Read(&event));
  const auto status = reader->Finish();
  EXPECT_EQ(status.error_code(), grpc::StatusCode::FAILED_PRECONDITION);
  EXPECT_THAT(status.error_message(), HasSubstr("before the restore of 20"));
  EXPECT_TRUE(next.watch("jobs/1", 3).status.ok()) << "Without an epoch nothing is compared.";
}

TEST_F(BackupTest, AJobThatWasCancellingIsCancelledAndASuspendedOneWaitsForItsResume) {
  auto client = this->client();
  const std::string suspended = client.create(case_of_seconds());
  wait_for_samples(client, suspended, 5);
  ASSERT_TRUE(client.suspend(suspended).ok());
  const std::string stuck = client.create(endless_case());
  wait_for_samples(client, stuck, 5);
  const pid_t worker = client.worker_of(stuck);
  kill(worker, SIGSTOP);
  ASSERT_TRUE(client.cancel(stuck).ok());
  store::take_backup(data_folder(), backup());
  kill(worker, SIGCONT);
  store::restore_backup(backup(), restored());
  restart_on_the_restored();
  auto next = this->client();
  EXPECT_EQ(next.get(stuck).state(), v1::Job::CANCELLED);
  EXPECT_EQ(next.get(suspended).state(), v1::Job::SUSPENDED);
  EXPECT_THAT(next.history(suspended), IsEmpty());
  ASSERT_TRUE(next.resume(suspended).ok());
  ASSERT_TRUE(next.watch(suspended).status.ok());
  EXPECT_EQ(next.history(suspended).size(), 200U);
}

TEST_F(BackupTest, ATargetThatIsTakenIsRefusedWithWords) {
  store::take_backup(data_folder(), backup());
  EXPECT_THAT(refusal([&] { store::take_backup(data_folder(), backup()); }), HasSubstr("is not empty"));
  EXPECT_THAT(refusal([&] { store::restore_backup(backup(), data_folder()); }),
              HasSubstr("is in use by a running daemon (process " + std::to_string(getpid()) + ")"));
  std::filesystem::create_directory(restored());
  std::ofstream(restored() / "mine") << "text";
  EXPECT_THAT(refusal([&] { store::restore_backup(backup(), restored()); }), HasSubstr("is not empty"));
  std::ofstream(folder_.path() / "file") << "text";
  EXPECT_THAT(refusal([&] { store::restore_backup(backup(), folder_.path() / "file"); }), HasSubstr("is not a folder"));
  EXPECT_THAT(refusal([&] { store::take_backup(restored(), folder_.path() / "new"); }),
              HasSubstr("is not a data folder"));
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "new"));
  std::filesystem::remove(restored() / "mine");
  store::restore_backup(backup(), restored());
  EXPECT_TRUE(std::filesystem::exists(restored() / "journal.sqlite"));
}

TEST_F(BackupTest, ALinkInThePlaceOfAnUnfinishedBackupIsRefusedAndNothingBehindItIsDeleted) {
  std::filesystem::create_directories(folder_.path() / "foreign" / "thesis");
  std::filesystem::create_directory_symlink(folder_.path() / "foreign", folder_.path() / ".backup.partial");
  EXPECT_THAT(refusal([&] { store::take_backup(data_folder(), backup()); }), HasSubstr("is a symbolic link"));
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "foreign" / "thesis"));
}

TEST_F(BackupTest, AManifestThatIsNoFileOrNamesAFileTwiceIsRefusedAtOnce) {
  store::take_backup(data_folder(), backup());
  auto manifest = store::read_manifest(backup());
  manifest.files.resize(20'000, manifest.files.front());
  std::ofstream(backup() / "MANIFEST") << text_of(manifest);
  EXPECT_THAT(refusal([&] { store::verify_folder(backup()); }), HasSubstr("MANIFEST is damaged"));
  // A file of 8 TB is not read to find that it has changed.
  manifest.files.resize(1);
  std::ofstream(backup() / "MANIFEST") << text_of(manifest);
  std::filesystem::resize_file(backup() / "journal.sqlite", std::uintmax_t{8} << 40);
  EXPECT_THAT(store::verify_folder(backup()).problems, ElementsAre(HasSubstr("journal.sqlite has changed")));
  std::filesystem::remove(backup() / "journal.sqlite");
  std::filesystem::create_symlink(data_folder() / "journal.sqlite", backup() / "journal.sqlite");
  EXPECT_THAT(store::verify_folder(backup()).problems, ElementsAre(HasSubstr("is a symbolic link")));
  std::filesystem::remove(backup() / "MANIFEST");
  ASSERT_EQ(mkfifo((backup() / "MANIFEST").c_str(), 0600), 0);
  EXPECT_THAT(refusal([&] { store::verify_folder(backup()); }), HasSubstr("is not a regular file"));
}

TEST_F(BackupTest, WhatAKilledRestoreLeftIsNoDataFolderAndTheNextOneReplacesIt) {
  store::take_backup(data_folder(), backup());
  const auto half = folder_.path() / ".restored.partial";
  std::filesystem::create_directories(half / "jobs" / "7");
  std::ofstream(half / "journal.sqlite") << "half";
  store::restore_backup(backup(), restored());
  EXPECT_FALSE(std::filesystem::exists(half));
  EXPECT_FALSE(std::filesystem::exists(restored() / "jobs" / "7"));
  EXPECT_THAT(store::verify_folder(restored()).problems, IsEmpty());
}

TEST_F(BackupTest, EveryFlippedBitOfABackupIsFoundAndNothingIsRestoredOfIt) {
  auto client = this->client();
  make_ended_jobs(client);
  store::take_backup(data_folder(), backup());
  for (const std::string name : {"journal.sqlite", "jobs/2/result.h5", "MANIFEST"}) {
    const auto path = backup() / name;
    const auto size = std::filesystem::file_size(path);
    for (const auto offset : {std::uintmax_t{30}, size / 2, size - 20}) {
      flip_bits(path, offset, 4);
      std::string words;
      try {
        for (const auto& problem : store::verify_folder(backup()).problems) words += problem;
      } catch (const ServiceError& error) {
        words = error.what();
      }
      EXPECT_THAT(words, HasSubstr(name)) << offset;
      EXPECT_THAT(words, HasSubstr("Use another backup")) << offset;
      DaemonProcess restore({"restore", backup().string(), "--data", restored().string()});
      EXPECT_EQ(restore.wait(), 1);
      EXPECT_FALSE(std::filesystem::exists(restored()));
      flip_bits(path, offset, 4);
    }
  }
  std::filesystem::remove(backup() / "jobs/2/result.h5");
  EXPECT_THAT(store::verify_folder(backup()).problems, ElementsAre(HasSubstr("jobs/2/result.h5")));
}

TEST_F(BackupTest, WhatIsWrongWithADataFolderIsNamedWithItsRemedyWhileTheDaemonRuns) {
  auto client = this->client();
  make_ended_jobs(client);
  EXPECT_THAT(store::verify_folder(data_folder()).problems, IsEmpty());
  flip_bits(data_folder() / "jobs/1/result.h5", 2000);
  std::filesystem::remove(data_folder() / "jobs/2/result.h5");
  std::filesystem::create_directory(data_folder() / "jobs/99");
  {
    store::Database database(data_folder() / "journal.sqlite");
    store::Statement(database, "UPDATE events SET payload = ?1 WHERE job = 3 AND sequence = 2")
        .bind_blob(1, std::string(40, '\xff'))
        .run();
    // As of a flipped bit: the row can be read, but is not as it was.
    database.execute("DROP TRIGGER seal_changed_jobs; UPDATE jobs SET priority = 1 WHERE number = 4");
  }
  const auto found = store::verify_folder(data_folder());
  EXPECT_THAT(found.problems, ElementsAre(HasSubstr("jobs/4"), HasSubstr("Event 2 of jobs/3"),
                                          HasSubstr("jobs/1/result.h5 is damaged"), HasSubstr("jobs/2/result.h5")));
  for (const auto& problem : found.problems) EXPECT_THAT(problem, HasSubstr("Restore a backup"));
  EXPECT_THAT(found.notes, ElementsAre(HasSubstr("jobs/99")));
  std::filesystem::create_directory(data_folder() / "jobs/\x1b[31m\u202e");
  const auto verified = e2e::run({CELLCRUSHD_PROGRAM, "verify", data_folder().string()}, std::chrono::seconds(20));
  EXPECT_EQ(verified.exit_code, 1);
  EXPECT_THAT(verified.output, HasSubstr("jobs/\\x1b[31m\\xe2\\x80\\xae belongs to no job"));

  // The rest of a damaged folder can be backed up, and the backup says what it lacks.
  const auto manifest = store::take_backup(data_folder(), backup());
  EXPECT_THAT(manifest.lost, UnorderedElementsAre(HasSubstr("jobs/1"), HasSubstr("jobs/2"),
                                                  HasSubstr("Event 2 of jobs/3"), HasSubstr("jobs/4")));
  EXPECT_THAT(store::verify_folder(backup()).notes, SizeIs(4));
  EXPECT_NO_THROW(store::restore_backup(backup(), restored()));
}

TEST_F(BackupTest, TheProgramBacksUpVerifiesAndRestoresAndSaysWhat) {
  auto client = this->client();
  make_ended_jobs(client);
  const auto run = [](const std::vector<std::string>& arguments) {
    DaemonProcess process(arguments);
    return process.wait();
  };
  EXPECT_EQ(run({"backup", backup().string(), "--data", data_folder().string()}), 0);
  EXPECT_EQ(run({"verify", backup().string()}), 0);
  EXPECT_EQ(run({"verify", data_folder().string()}), 0);
  EXPECT_EQ(run({"verify", folder_.path().string()}), 1);
  EXPECT_EQ(run({"restore", backup().string(), "--data", data_folder().string()}), 1);
  EXPECT_EQ(run({"--data", restored().string(), "restore", backup().string()}), 0);
  EXPECT_EQ(run({"backup"}), 2);
  struct stat status {};
  ASSERT_EQ(stat(restored().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0700U);
  restart_on_the_restored();
  EXPECT_EQ(this->client().get("jobs/4").state(), v1::Job::SUCCEEDED);
}

}  // namespace
}  // namespace cellcrush::testing

// What is found in a data folder that does not belong there, or cannot be used: the daemon starts, serves the rest and
// names it.
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "faults/fault_fixture.h"
#include "server/job_numbers.h"
#include "server/small_case.h"
#include "store/sqlite.h"

namespace cellcrush::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

class SetAsideTest : public FaultFixture {
 protected:
  [[nodiscard]] std::filesystem::path jobs() const { return data_folder() / "jobs"; }
  [[nodiscard]] std::filesystem::path set_aside() const { return data_folder() / "set-aside"; }

  // What a daemon that does not start writes.
  std::string refused_start() {
    begin_daemon();
    EXPECT_NE(daemon_->wait(), 0);
    return daemon_->errors();
  }

  void expect_that_it_serves(Client& client) { const std::string job = client.create(tiny_case(), v1::Job::SUCCEEDED); }
};

TEST_F(SetAsideTest, WhatBelongsToNoJobIsSetAsideAndNeverAdopted) {
  start_daemon();
  {
    auto client = this->client();
    for (int i = 0; i < 2; ++i) ASSERT_TRUE(client.wait_for_state(client.create(tiny_case()), v1::Job::SUCCEEDED));
  }
  stop_daemon();
  // What a job of another journal left: reports and a result, of another case.
  std::filesystem::create_directories(jobs() / "3");
  std::filesystem::copy_file(jobs() / "2" / "result.h5", jobs() / "3" / "result.h5");
  std::ofstream(jobs() / "3" / "reports") << "of another case";
  std::filesystem::create_directories(jobs() / "lost+found");
  std::filesystem::create_directories(jobs() / "not a number");
  std::filesystem::create_directories(jobs() / "007");
  std::filesystem::create_symlink("nowhere", jobs() / "9");
  std::ofstream(jobs() / "8") << "a file";
  start_daemon();
  auto client = this->client();
  EXPECT_EQ(client.get("jobs/2").state(), v1::Job::SUCCEEDED);
  EXPECT_TRUE(std::filesystem::exists(set_aside() / "3" / "reports"));
  for (const char* name : {"not a number", "007", "8"})
    EXPECT_TRUE(std::filesystem::exists(set_aside() / name)) << name;
  EXPECT_TRUE(std::filesystem::is_symlink(set_aside() / "9"));
  EXPECT_TRUE(std::filesystem::exists(jobs() / "lost+found"));
  const std::string third = client.create(endless_case());
  EXPECT_EQ(third, "jobs/3");
  wait_for_samples(client, third, 5);
  EXPECT_TRUE(client.cancel(third).ok());
  expect_that_it_serves(client);
  EXPECT_THAT(stop_daemon(),
              AllOf(HasSubstr("jobs/3 was moved aside to "), HasSubstr("/3 because it belongs to no job."),
                    HasSubstr("jobs/007 was"), HasSubstr("jobs/9 was"), Not(HasSubstr("lost+found"))));
}

TEST_F(SetAsideTest, AFolderThatCannotBeUsedCostsOnlyItsJob) {
  start_daemon({"--workers", "3", "--checkpoint-interval", "0.05"});
  std::vector<std::string> names;
  {
    auto client = this->client();
    ASSERT_TRUE(client.wait_for_state(client.create(tiny_case()), v1::Job::SUCCEEDED));
    for (int i = 0; i < 3; ++i) names.push_back(client.create(case_of_seconds()));
    for (const auto& name : names) wait_for_samples(client, name, 5);
  }
  stop_daemon();
  // A FIFO blocks whoever opens it, and a file is no folder.
  const auto reports = data_folder() / names[0] / "reports";
  std::filesystem::remove(reports);
  ASSERT_EQ(mkfifo(reports.c_str(), 0600), 0);
  std::filesystem::remove_all(data_folder() / names[1]);
  std::ofstream(data_folder() / names[1]) << "a file";
  const auto result = data_folder() / "jobs/1/result.h5";
  std::filesystem::rename(result, folder_.path() / "result.h5");
  ASSERT_EQ(mkfifo(result.c_str(), 0600), 0);
  start_daemon({"--workers", "3", "--checkpoint-interval", "0.05"});
  auto client = this->client();
  for (const auto& name : names) ASSERT_TRUE(client.watch(name).status.ok());
  for (const auto& name : names) {
    EXPECT_EQ(client.get(name).state(), v1::Job::SUCCEEDED) << client.get(name).cause_message();
    EXPECT_EQ(client.history(name).size(), 200U);
    EXPECT_TRUE(numbers_of(client, data_folder(), name) == numbers_of(client, data_folder(), names[2]));
  }
  EXPECT_GT(client.get(names[0]).begun_again_sequence(), 0);
  EXPECT_GT(client.get(names[1]).begun_again_sequence(), 0);
  EXPECT_EQ(client.get(names[2]).begun_again_sequence(), 0);
  grpc::Status status;
  EXPECT_THAT(client.download("jobs/1", 0, status), IsEmpty());
  EXPECT_THAT(status.error_message(), HasSubstr("it is not a regular file"));
  auto request = named<v1::GetFrameRequest>("jobs/1");
  const auto context = bounded_context();
  const auto reader = client.jobs->GetFrame(context.get(), request);
  v1::GetFrameResponse response;
  EXPECT_FALSE(reader->Read(&response));
  EXPECT_THAT(reader->Finish().error_message(), HasSubstr("not a regular file"));
  EXPECT_THAT(
      stop_daemon(),
      AllOf(HasSubstr(names[0] + " was moved aside to "), HasSubstr("because reports in it is not a regular file"),
            HasSubstr(names[1] + " was moved aside to "), HasSubstr("because it is not a folder")));
}

// A link that waits where the next job's folder will be, and others in the place of a job's files.
TEST_F(SetAsideTest, NothingIsWrittenOrReadThroughALink) {
  const auto foreign = data_folder().parent_path() / "foreign";
  std::filesystem::create_directories(foreign);
  std::ofstream(foreign / "secret") << "of another";
  start_daemon();
  auto client = this->client();
  std::filesystem::create_directory_symlink(foreign, jobs() / "1");
  EXPECT_EQ(client.create(tiny_case(), v1::Job::SUCCEEDED), "jobs/1");
  EXPECT_TRUE(std::filesystem::is_symlink(set_aside() / "1"));
  const auto foreign_files = std::distance(std::filesystem::directory_iterator(foreign), {});
  EXPECT_EQ(foreign_files, 1) << "written through the link";
  for (const char* file : {"result.h5", "history"}) {
    std::filesystem::remove(jobs() / "1" / file);
    std::filesystem::create_symlink(foreign / "secret", jobs() / "1" / file);
    if (geteuid() == 0) {
      ASSERT_EQ(lchown((jobs() / "1" / file).c_str(), 1234, 1234), 0);
    }
  }
  grpc::Status status;
  EXPECT_THAT(client.history("jobs/1", status), IsEmpty());
  EXPECT_THAT(status.error_message(), HasSubstr("is a symbolic link"));
  if (geteuid() == 0) {
    EXPECT_THAT(client.download("jobs/1", 0, status), IsEmpty());
    EXPECT_THAT(status.error_message(), HasSubstr("is a symbolic link"));
  }
  EXPECT_TRUE(client.remove("jobs/1").ok());
  EXPECT_TRUE(std::filesystem::exists(foreign / "secret"));
  EXPECT_THAT(stop_daemon(), HasSubstr("cannot be used (a symbolic link) and was moved aside"));
}

// No daemon starts on what others could replace, and the rest of its files are its own.
TEST_F(SetAsideTest, ADataFolderOfOthersOrOfLinksIsRefusedWithTheRemedy) {
  std::filesystem::create_directories(data_folder());
  chmod(data_folder().c_str(), 0777);
  EXPECT_THAT(refused_start(), AllOf(HasSubstr("has mode 0777: users other than its owner can write in it"),
                                     HasSubstr("chmod go-w " + data_folder().string())));
  chmod(data_folder().c_str(), 0700);
  const auto elsewhere = data_folder().parent_path() / "elsewhere";
  std::filesystem::create_directory(elsewhere);
  for (const char* name : {"jobs", "lock", "journal.sqlite", "journal.sqlite-wal"}) {
    std::filesystem::create_symlink(elsewhere / (name == std::string("jobs") ? "" : name), data_folder() / name);
    EXPECT_THAT(refused_start(), HasSubstr(name + std::string(" cannot be used: it is a symbolic link")));
    std::filesystem::remove(data_folder() / name);
  }
  EXPECT_TRUE(std::filesystem::is_empty(elsewhere));
  ASSERT_EQ(mkfifo((data_folder() / "journal.sqlite").c_str(), 0600), 0);
  EXPECT_THAT(refused_start(), HasSubstr("journal.sqlite cannot be used: it is not a regular file"));
}

TEST_F(SetAsideTest, AFolderOfNobodysRightsCostsOnlyItsJob) {
  start_daemon({"--workers", "1"});
  std::string ended;
  std::string waiting;
  {
    auto client = this->client();
    ended = client.create(tiny_case(), v1::Job::SUCCEEDED);
    waiting = create_with_samples(client, case_of_seconds(), 5);
  }
  stop_daemon();
  for (const auto& name : {ended, waiting}) chmod((data_folder() / name).c_str(), 0);
  start_daemon({"--workers", "1"});
  auto client = this->client();
  expect_success(client, waiting);
  EXPECT_EQ(client.history(waiting).size(), 200U);
  EXPECT_EQ(client.get(ended).state(), v1::Job::SUCCEEDED);
  if (geteuid() != 0) {
    grpc::Status status;
    EXPECT_THAT(client.download(ended, 0, status), IsEmpty());
    EXPECT_THAT(status.error_message(), HasSubstr("Permission denied"));
  }
  chmod((data_folder() / ended).c_str(), 0700);
  stop_daemon();
}

TEST_F(SetAsideTest, AFileThatIsNoJournalIsNamedWithTheRemedy) {
  std::filesystem::create_directories(data_folder());
  std::ofstream(journal()) << std::string(5000, 'x');
  begin_daemon();
  EXPECT_EQ(daemon_->wait(), 1);
  EXPECT_THAT(daemon_->errors(),
              AllOf(HasSubstr(journal().string() + " is not a cellcrushd journal"), HasSubstr("file is not a database"),
                    HasSubstr("cellcrushd restore"), HasSubstr("move the file away")));
}

TEST_F(SetAsideTest, ADamagedPageOfTheEventsCostsOnlyWhatItHeld) {
  start_daemon({"--workers", "1"});
  std::size_t sample_count = 0;
  {
    auto client = this->client();
    // Their events fill several pages.
    auto submitted = tiny_case();
    std::string title;
    for (int i = 0; i < 175; ++i) title += "\U0001F41D";
    submitted.set_title(title);
    for (int i = 0; i < 4; ++i) ASSERT_TRUE(client.wait_for_state(client.create(submitted), v1::Job::SUCCEEDED));
    sample_count = client.history("jobs/4").size();
  }
  stop_daemon();
  std::int64_t page = 0;
  {
    store::Database database(journal(), store::Database::Access::single_file);
    store::Statement leaf(
        database, "SELECT pageno FROM dbstat WHERE name = 'events' AND pagetype = 'leaf' ORDER BY path LIMIT 1");
    if (leaf.step()) page = leaf.integer(0);
  }
  if (page == 0) GTEST_SKIP() << "This SQLite has no dbstat.";
  std::fstream file(journal(), std::ios::in | std::ios::out | std::ios::binary);
  file.seekp((page - 1) * 4096);
  file << std::string(4096, '\xee');
  file.close();
  start_daemon({"--workers", "1"});
  auto client = this->client();
  grpc::Status status;
  client.history("jobs/1", status);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::DATA_LOSS) << status.error_message();
  EXPECT_THAT(status.error_message(), AllOf(HasSubstr(journal().string() + " is damaged"), HasSubstr("restore")));
  EXPECT_EQ(client.get("jobs/1").state(), v1::Job::SUCCEEDED);
  EXPECT_EQ(client.history("jobs/4").size(), sample_count);
  stop_daemon();
}

TEST_F(SetAsideTest, AFolderThatOthersCanReadIsNamedAtTheStart) {
  std::filesystem::create_directories(data_folder());
  chmod(data_folder().c_str(), 0755);
  start_daemon();
  EXPECT_THAT(stop_daemon(), AllOf(HasSubstr(data_folder().string() + " has mode 0755"), HasSubstr("chmod 700")));
  chmod(data_folder().c_str(), 0700);
  start_daemon();
  EXPECT_THAT(stop_daemon(), Not(HasSubstr("has mode")));
}

}  // namespace
}  // namespace cellcrush::testing

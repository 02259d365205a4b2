// A row of the journal that a disk has damaged while there was no daemon.
#include <gmock/gmock.h>

#include <csignal>
#include <iostream>

#include "faults/fault_fixture.h"
#include "server/job_numbers.h"
#include "server/small_case.h"
#include "store/journal_reader.h"
#include "store/report_log.h"
#include "store/verification.h"
#include "translate/case_words.h"

namespace cellcrush::testing {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

class CorruptRowTest : public FaultFixture {
 protected:
  // Replaces a blob by bytes that are no message; the row of a wrong checksum gets no other one.
  void damage(const std::string& table, const std::string& column, const std::string& where) const {
    store::Database database(journal());
    database.execute(("UPDATE " + table + " SET checksum = 0 WHERE " + where).c_str());
    store::Statement(database, "UPDATE " + table + " SET " + column + " = ?1 WHERE " + where)
        .bind_blob(1, std::string(40, '\xff'))
        .run();
  }

  // Many jobs that wait; the first runs once a daemon is there.
  void fill() {
    fill_journal(data_folder(), count_, endless_case());
    store::JournalReader reader(journal());
    v1::ListJobsResponse stored;
    for (auto& row : reader.list_jobs({}, false, 1, static_cast<int>(count_))) *stored.add_jobs() = std::move(row.job);
    translate::add_words(stored);
    for (const auto& job : stored.jobs()) before_[job.name()] = job;
  }

  // That all jobs but the first are served as they were, except `damaged`.
  void expect_the_others_intact(Client& client, const std::string& damaged) {
    auto after = all_jobs(client);
    EXPECT_EQ(after.size(), static_cast<std::size_t>(count_));
    int intact = 0;
    for (const auto& [name, job] : before_) {
      if (name == damaged) continue;
      ASSERT_EQ(after[name].SerializeAsString(), job.SerializeAsString()) << name;
      ++intact;
    }
    std::cout << "one damaged row of " << count_ << " jobs: " << intact << " others served as they were\n";
  }

  const std::int64_t count_ = rounds(500, 10'000);
  const std::vector<std::string> arguments_ = {"--workers", "1"};
  std::map<std::string, v1::Job> before_;
};

TEST_F(CorruptRowTest, AJobThatCannotBeReadIsRestoredFromItsNewestEvent) {
  fill();
  damage("jobs", "job", "number = 77");
  start_daemon(arguments_);
  auto client = this->client();
  expect_the_others_intact(client, "none");
  EXPECT_THAT(stop_daemon(), HasSubstr("entry of jobs/77 was damaged and has been rebuilt"));
}

TEST_F(CorruptRowTest, AWaitingJobWhoseCaseCannotBeReadFailsAndTheOthersGoOn) {
  fill();
  damage("jobs", "submitted_case", "number = 77");
  start_daemon(arguments_);
  auto client = this->client();
  expect_the_others_intact(client, "jobs/77");
  const auto job = client.get("jobs/77");
  EXPECT_EQ(job.state(), v1::Job::FAILED);
  EXPECT_EQ(job.cause(), v1::Job::STORE_CORRUPT);
  EXPECT_THAT(job.cause_message(), HasSubstr("cannot be read"));
  EXPECT_FALSE(job.remedy().empty());
  std::int64_t last = 0;
  EXPECT_TRUE(watch_soundly(client, "jobs/77", 0, &last).ok());
  EXPECT_EQ(last, 2);
  EXPECT_TRUE(client.remove("jobs/77").ok());
  EXPECT_THAT(stop_daemon(), HasSubstr("jobs/77 is FAILED with STORE_CORRUPT"));
}

TEST_F(CorruptRowTest, AJobOfWhichNothingCanBeReadFailsAndTheOthersGoOn) {
  fill();
  damage("jobs", "job", "number = 77");
  damage("events", "payload", "job = 77");
  start_daemon(arguments_);
  auto client = this->client();
  expect_the_others_intact(client, "jobs/77");
  EXPECT_EQ(client.get("jobs/77").cause(), v1::Job::STORE_CORRUPT);
  std::int64_t last = 0;
  const auto status = watch_soundly(client, "jobs/77", 0, &last);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::DATA_LOSS);
  EXPECT_THAT(status.error_message(), HasSubstr("Event 1 of jobs/77"));
  EXPECT_TRUE(watch_soundly(client, "jobs/77", 1, &last).ok());
  EXPECT_EQ(last, 2);
}

TEST_F(CorruptRowTest, AResultThatCannotBeReadCostsOnlyItsSamples) {
  start_daemon(arguments_);
  std::string job;
  std::string next;
  {
    auto client = this->client();
    job = client.create(tiny_case());
    next = client.create(tiny_case());
    for (const auto& name : {job, next}) EXPECT_TRUE(client.wait_for_state(name, v1::Job::SUCCEEDED));
  }
  stop_daemon();
  const auto result = data_folder() / job / "result.h5";
  flip_bits(result, std::filesystem::file_size(result) / 2);
  start_daemon(arguments_);
  auto client = this->client();
  EXPECT_EQ(client.get(job).state(), v1::Job::SUCCEEDED);
  std::int64_t last = 0;
  const auto status = watch_soundly(client, job, 0, &last);
  EXPECT_EQ(status.error_code(), grpc::StatusCode::DATA_LOSS);
  EXPECT_EQ(last, 2) << "What comes before the samples is given.";
  EXPECT_THAT(status.error_message(),
              AllOf(HasSubstr("Event 3 of " + job + " cannot be read"), HasSubstr("watch with after_sequence 23.")));
  EXPECT_TRUE(watch_soundly(client, job, 23, &last).ok()) << "What comes behind them is given.";
  EXPECT_EQ(last, 24);
  grpc::Status history;
  EXPECT_THAT(client.history(job, history), IsEmpty());
  EXPECT_EQ(history.error_code(), grpc::StatusCode::DATA_LOSS);
  EXPECT_TRUE(watch_soundly(client, next, 0, &last).ok());
  EXPECT_EQ(client.history(next).size(), 21U);
}

TEST_F(CorruptRowTest, ChangesThatADamagedWalHasLostAreSaidInLogHealthAndVerify) {
  start_daemon(arguments_);
  std::string epoch;
  {
    auto client = this->client();
    for (int i = 0; i < 4; ++i) EXPECT_TRUE(client.wait_for_state(client.create(tiny_case()), v1::Job::SUCCEEDED));
    EXPECT_TRUE(is_serving(client, "cellcrush.journal"));
    epoch = client.watch("jobs/1").events.front().snapshot().epoch();
  }
  kill_daemon();
  const auto wal = journal().string() + "-wal";
  EXPECT_THAT(store::verify_folder(data_folder()).problems, IsEmpty());
  flip_bits(wal, std::filesystem::file_size(wal) * 3 / 4);
  const auto found = store::verify_folder(data_folder()).problems;
  ASSERT_FALSE(found.empty());
  EXPECT_THAT(found.front(), HasSubstr("The journal lacks its last"));
  start_daemon(arguments_);
  auto client = this->client();
  EXPECT_TRUE(wait_until([&] { return !is_serving(client, "cellcrush.journal"); }));
  EXPECT_EQ(client.get("jobs/1").state(), v1::Job::SUCCEEDED);
  EXPECT_NE(client.watch("jobs/1").events.front().snapshot().epoch(), epoch) << "Numbers are used again.";
  EXPECT_THAT(stop_daemon(), HasSubstr("The journal lacks its last"));
}

TEST_F(CorruptRowTest, AReportThatCannotBeReadEndsTheJobWhichKeepsTheSamplesBefore) {
  start_daemon(arguments_);
  std::string job;
  {
    auto client = this->client();
    job = client.create(endless_case());
    wait_for_samples(client, job, 10);
    const pid_t worker = client.worker_of(job);
    kill_daemon();
    kill(worker, SIGKILL);
  }
  {
    store::ReportLogReader reports(data_folder() / job / "reports");
    v1::Sample sample;
    for (int i = 0; i < 5; ++i) ASSERT_EQ(reports.read_sample(sample), store::ReportLogReader::Read::message);
    flip_bits(data_folder() / job / "reports", reports.offset() - 1);
  }
  start_daemon(arguments_);
  auto client = this->client();
  EXPECT_TRUE(client.wait_for_state(job, v1::Job::FAILED));
  grpc::Status history;
  EXPECT_EQ(client.history(job, history).size(), 4U);
  EXPECT_EQ(history.error_code(), grpc::StatusCode::DATA_LOSS);
  const std::string next = client.create(tiny_case());
  EXPECT_TRUE(client.wait_for_state(next, v1::Job::SUCCEEDED));
}

}  // namespace
}  // namespace cellcrush::testing

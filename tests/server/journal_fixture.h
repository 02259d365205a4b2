#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>

#include "server/small_case.h"
#include "server/temporary_folder.h"
#include "store/journal.h"
#include "store/journal_reader.h"

namespace cellcrush::store {

/// A journal in a folder of its own, with one to read it.
class JournalTest : public ::testing::Test {
 protected:
  void SetUp() override { reopen(); }

  void reopen() {
    reader_.reset();
    journal_.reset();
    journal_.emplace(path(), [this](std::int64_t) { ++told_; });
    reader_.emplace(path());
  }

  [[nodiscard]] std::filesystem::path path() const { return folder_.path() / "journal.sqlite"; }

  std::int64_t create(const std::string& request_id = "", const std::string& hash = "") {
    v1::Job job;
    *job.mutable_case_() = testing::small_case();
    (*job.mutable_labels())["who"] = "me";
    return journal_->create_job(job, request_id, hash).job;
  }

  void change(std::int64_t job, v1::Job::State state) {
    StateChange change;
    change.state = state;
    change.worker_pid = state == v1::Job::RUNNING ? 4711 : 0;
    if (state == v1::Job::SUCCEEDED) change.summary.emplace().set_step_count(99);
    journal_->change_state(job, change);
  }

  static v1::Sample sample(int step) {
    v1::Sample out;
    out.set_step(step);
    return out;
  }

  testing::TemporaryFolder folder_;
  std::atomic<int> told_ = 0;
  std::optional<Journal> journal_;
  std::optional<JournalReader> reader_;
};

/// What the fifth version had: no executors.
inline constexpr const char* kWithoutExecutor = "ALTER TABLE jobs DROP COLUMN executor; PRAGMA user_version = 5;";

/// What the third version had: neither that nor columns and labels to search by, no service clock and no facts.
inline constexpr const char* kWithoutSearchColumns = R"sql(
ALTER TABLE jobs DROP COLUMN executor;
DROP TRIGGER note_state;
DROP TRIGGER note_deleted_job;
DROP TRIGGER note_sweep;
DROP TRIGGER note_retry;
DROP TRIGGER note_deleted_sweep;
DROP TABLE changes;
DROP INDEX jobs_by_request;
DROP INDEX sweeps_by_request;
DROP INDEX jobs_by_owner;
DROP INDEX jobs_by_owner_bytes;
DROP INDEX jobs_by_title;
DROP INDEX jobs_by_end;
DROP INDEX jobs_to_measure;
DROP INDEX sweeps_in_deletion;
DROP TABLE job_labels;
DROP TABLE service_clock;
DROP TABLE facts;
ALTER TABLE jobs DROP COLUMN owner;
ALTER TABLE jobs DROP COLUMN title;
ALTER TABLE jobs DROP COLUMN ended_at;
ALTER TABLE jobs DROP COLUMN bytes;
ALTER TABLE jobs DROP COLUMN measured;
ALTER TABLE sweeps DROP COLUMN owner;
ALTER TABLE sweeps DROP COLUMN deleting;
CREATE UNIQUE INDEX jobs_by_request ON jobs(request_id) WHERE request_id IS NOT NULL;
CREATE UNIQUE INDEX sweeps_by_request ON sweeps(request_id) WHERE request_id IS NOT NULL;
PRAGMA user_version = 3;
)sql";

/// What the second version had: no priorities, submissions and predictions.
inline constexpr const char* kWithoutQueueColumnsOfJobs =
    "ALTER TABLE jobs DROP COLUMN priority; ALTER TABLE jobs DROP COLUMN submission; "
    "ALTER TABLE jobs DROP COLUMN element_steps;";
inline constexpr const char* kWithoutQueueColumnsOfSweeps =
    "ALTER TABLE sweeps DROP COLUMN max_failures; ALTER TABLE sweep_jobs DROP COLUMN stopped;";

}  // namespace cellcrush::store

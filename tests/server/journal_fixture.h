#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <optional>
#include <string>

#include "programs/temporary_folder.h"
#include "server/sample_writer.h"
#include "server/small_case.h"
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

  void add_sample(std::int64_t job, const v1::Sample& sample, std::chrono::milliseconds within = Journal::kSoon) {
    reported_.add(*journal_, job, sample, within);
  }

  static v1::Sample sample(int step) {
    v1::Sample out;
    out.set_step(step);
    return out;
  }

  testing::TemporaryFolder folder_;
  testing::SampleWriter reported_{folder_.path()};
  std::atomic<int> told_ = 0;
  std::optional<Journal> journal_;
  std::optional<JournalReader> reader_;
};

}  // namespace cellcrush::store

#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <utility>

#include "store/job_folder.h"
#include "store/journal.h"
#include "store/report_log.h"
#include "store/resource_name.h"

namespace cellcrush::testing {

/// Reports samples as workers do, and notes them in the journal of the data folder as the daemon does.
class SampleWriter {
 public:
  explicit SampleWriter(std::filesystem::path root) : root_(std::move(root)) {}

  void add(store::Journal& journal, std::int64_t job, v1::Sample sample,
           std::chrono::milliseconds within = store::Journal::kSoon) {
    auto& [log, count] = reports_[job];
    if (!log) {
      std::filesystem::create_directories(folder_of(job).root());
      log = std::make_unique<store::ReportLog>(folder_of(job).reports());
    }
    worker::Report report;
    *report.mutable_sample() = std::move(sample);
    log->append(report);
    journal.note_samples(job, ++count, within);
  }

  /// The job begins again, with an empty folder.
  void discard(std::int64_t job) {
    reports_.erase(job);
    std::filesystem::remove_all(folder_of(job).root());
  }

  [[nodiscard]] store::JobFolder folder_of(std::int64_t job) const {
    return store::JobFolder(root_ / store::name_of(job));
  }

 private:
  std::filesystem::path root_;
  std::map<std::int64_t, std::pair<std::unique_ptr<store::ReportLog>, std::int64_t>> reports_;
};

}  // namespace cellcrush::testing

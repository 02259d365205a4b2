#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace cellcrush::store {

/// The folder that one daemon at a time owns:
///   lock            held while a daemon runs; holds its process number
///   journal.sqlite  journal_format.md
///   jobs/N/         what job N leaves: result.h5 (result_format.md)
class DataFolder {
 public:
  /// Makes the folder, readable for its owner alone, where there is none, and takes the lock.
  /// Throws ServiceError: failed_precondition when another daemon has it, internal when it cannot be used.
  explicit DataFolder(const std::filesystem::path& root);
  ~DataFolder();
  DataFolder(const DataFolder&) = delete;
  DataFolder& operator=(const DataFolder&) = delete;

  [[nodiscard]] std::filesystem::path journal() const { return root_ / "journal.sqlite"; }
  [[nodiscard]] std::filesystem::path job_folder(std::int64_t job) const {
    return root_ / "jobs" / std::to_string(job);
  }
  [[nodiscard]] std::filesystem::path result(std::int64_t job) const { return job_folder(job) / "result.h5"; }
  /// What the worker writes until the result is complete.
  [[nodiscard]] std::filesystem::path partial_result(std::int64_t job) const {
    return job_folder(job) / "result.h5.partial";
  }

  /// Makes the job's folder, empty: what an earlier, broken-off run left in it is removed. Throws ServiceError.
  void prepare_job_folder(std::int64_t job) const;

  /// Removes the job's folder and all in it; nothing happens when there is none. Throws ServiceError.
  void remove_job_folder(std::int64_t job) const;

 private:
  std::filesystem::path root_;
  int lock_ = -1;
};

}  // namespace cellcrush::store

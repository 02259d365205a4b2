#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "worker/job_folder.h"

namespace cellcrush::store {

/// The folder that one daemon at a time owns:
///   lock            held while a daemon runs; holds its process number
///   journal.sqlite  journal_format.md
///   ballast         room for when the disk is full
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
  [[nodiscard]] worker::JobFolder job_folder(std::int64_t job) const {
    return worker::JobFolder(root_ / "jobs" / std::to_string(job));
  }

  /// Makes the job's folder if there is none. Throws ServiceError.
  void make_job_folder(std::int64_t job) const;

  /// Leaves nothing but the result in the folder of a job that has ended. Throws ServiceError.
  void clean_job_folder(std::int64_t job) const;

  /// Bytes that the disk has left for this user.
  [[nodiscard]] std::int64_t free_bytes() const;

  /// A file that holds some room for when the disk is full, so that what is owed can still be written. `keep` makes it where there
  /// is none and room for it, `give_up` removes it.
  void keep_ballast() const;
  void give_up_ballast() const;

  /// Numbers of the jobs whose folders hold more than a result.
  [[nodiscard]] std::vector<std::int64_t> jobs_with_reports() const;

  /// Removes the job's folder and all in it; nothing happens when there is none. Throws ServiceError.
  void remove_job_folder(std::int64_t job) const;

 private:
  [[nodiscard]] std::filesystem::path ballast() const { return root_ / "ballast"; }

  std::filesystem::path root_;
  int lock_ = -1;
};

}  // namespace cellcrush::store

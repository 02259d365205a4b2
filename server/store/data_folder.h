#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "store/job_folder.h"

namespace cellcrush::store {

/// Process of the daemon that runs on the folder, in words; nothing when none does.
std::optional<std::string> daemon_of(const std::filesystem::path& root);

/// The folder that one daemon at a time owns:
///   lock            held while a daemon runs; holds its process number
///   journal.sqlite  journal_format.md
///   ballast         room for what is owed when the disk is full
///   ballast.start   room for a start on a full disk
///   jobs/N/         what job N leaves: result.h5 (result_format.md)
///   set-aside/      what was found in jobs/ and belongs to no job, or could not be used
class DataFolder {
 public:
  /// Makes the folder, readable for its owner alone, where there is none, and takes the lock.
  /// Throws ServiceError: failed_precondition when another daemon has it, internal when it cannot be used.
  explicit DataFolder(const std::filesystem::path& root);
  ~DataFolder();
  DataFolder(const DataFolder&) = delete;
  DataFolder& operator=(const DataFolder&) = delete;

  [[nodiscard]] std::filesystem::path journal() const { return root_ / "journal.sqlite"; }
  [[nodiscard]] JobFolder job_folder(std::int64_t job) const { return JobFolder(root_ / "jobs" / std::to_string(job)); }

  /// Makes the job's folder if there is none. One that cannot be used, while others can, is renamed to
  /// jobs/N.set-aside-K, and a new one is made. Throws ServiceError: with the shortage where no folder can be used.
  void make_job_folder(std::int64_t job) const;

  /// Leaves nothing but the result in the folder of a job that has ended. Throws ServiceError.
  void clean_job_folder(std::int64_t job) const;

  /// Whether workers have reported something in the job's folder.
  [[nodiscard]] bool has_reports(std::int64_t job) const;

  /// Removes what workers left in the folder of a job that is to be begun again. Throws ServiceError.
  void discard_run(std::int64_t job) const;

  /// Bytes that the disk has left for this user.
  [[nodiscard]] std::int64_t free_bytes() const;

  /// Files that hold some room for when the disk is full: one for what is owed, one for the next start. `keep` makes
  /// them where there are none and says whether there is room for them, and throws ServiceError where they cannot be
  /// made for another reason; `give_up` removes the first. The second one goes when this is made and room is short.
  bool keep_ballast() const;
  void give_up_ballast() const;

  /// Whether the disk has no room left for files of a few pages.
  [[nodiscard]] bool is_full() const;

  /// Numbers of the jobs whose folders hold more than a result; folders that cannot be read are left out.
  [[nodiscard]] std::vector<std::int64_t> jobs_with_reports() const;

  /// Moves jobs/`name` to set-aside/ under a name that is free there, for the user to look at. Where it lies now.
  /// Throws ServiceError.
  std::filesystem::path set_aside(const std::string& name) const;

  /// Names in jobs/.
  [[nodiscard]] std::vector<std::string> names_in_jobs() const;

  /// Removes the job's folder and all in it; nothing happens when there is none. Throws ServiceError.
  void remove_job_folder(std::int64_t job) const;

 private:
  [[nodiscard]] std::filesystem::path ballast() const { return root_ / "ballast"; }
  [[nodiscard]] std::filesystem::path start_ballast() const { return root_ / "ballast.start"; }
  /// Makes and removes a folder beside those of the jobs. Throws ServiceError.
  void try_new_folder() const;
  void set_aside(std::int64_t job, const std::string& reason) const;

  std::filesystem::path root_;
  int lock_ = -1;
};

}  // namespace cellcrush::store

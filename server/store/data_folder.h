#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "open_file.h"
#include "store/job_folder.h"

namespace cellcrush::store {

/// Process of the daemon that runs on the folder, as text; nothing if none does.
std::optional<std::string> daemon_of(const std::filesystem::path& root);

/// The folder that one daemon at a time owns:
///   lock            held while a daemon runs; holds its process number
///   journal.sqlite  journal_format.md
///   journal.changes change_count.h
///   ballast         room for what is owed when the disk is full
///   ballast.start   room for a start on a full disk
///   jobs/N/         what job N leaves: result.h5 (result_format.md)
///   lattices/       large lattices of jobs that run (lattice_file.h)
///   set-aside/      what was found in jobs/ and belongs to no job, or could not be used
class DataFolder {
 public:
  /// Creates the folder if it is absent, readable for its owner only, and takes the lock. Throws ServiceError:
  /// failed_precondition if another daemon holds the lock or there are no locks, internal if the folder is unusable.
  explicit DataFolder(const std::filesystem::path& root);

  [[nodiscard]] std::filesystem::path journal() const { return root_ / "journal.sqlite"; }
  [[nodiscard]] JobFolder job_folder(std::int64_t job) const { return JobFolder(root_ / "jobs" / std::to_string(job)); }

  /// Creates the job's folder if it is absent. An unusable folder is renamed to jobs/N.set-aside-K and replaced, if new
  /// folders are usable. Throws ServiceError, with the shortage, if none is.
  void make_job_folder(std::int64_t job) const;

  /// Deletes everything but the result from the folder of an ended job. Without one, the reports become its history.
  /// Throws ServiceError.
  void clean_job_folder(std::int64_t job) const;

  [[nodiscard]] std::filesystem::path lattices() const { return root_ / "lattices"; }

  /// Whether the job's folder contains reports of workers.
  [[nodiscard]] bool has_reports(std::int64_t job) const;

  /// Deletes the workers' files from the folder of a job that restarts from step 0. Throws ServiceError.
  void discard_run(std::int64_t job) const;

  /// Free bytes on the disk for this user.
  [[nodiscard]] std::int64_t free_bytes() const;

  /// Ballast files reserve room for a full disk: one for pending writes, one for the next start. `keep_ballast` creates
  /// missing ones and returns whether there is room. It throws ServiceError if they cannot be created for another
  /// reason. `give_up_ballast` deletes the first. The second is deleted on construction if room is short.
  bool keep_ballast() const;
  void give_up_ballast() const;

  /// Whether the disk has no room for files of a few pages.
  [[nodiscard]] bool is_full() const;

  /// Numbers of the jobs whose folders contain more than a result, except unreadable folders.
  [[nodiscard]] std::vector<std::int64_t> jobs_with_reports() const;

  /// Moves jobs/`name` to set-aside/ under an unused name, for the user to inspect. Returns its new path. Throws
  /// ServiceError.
  std::filesystem::path set_aside(const std::string& name) const;

  /// Names of the entries in jobs/.
  [[nodiscard]] std::vector<std::string> names_in_jobs() const;

  /// Deletes the job's folder with its contents; no effect if it is absent. Throws ServiceError.
  void remove_job_folder(std::int64_t job) const;

 private:
  [[nodiscard]] std::filesystem::path ballast() const { return root_ / "ballast"; }
  [[nodiscard]] std::filesystem::path start_ballast() const { return root_ / "ballast.start"; }
  /// Creates and deletes a folder beside those of the jobs. Throws ServiceError.
  void try_new_folder() const;
  void set_aside(std::int64_t job, const std::string& reason) const;

  std::filesystem::path root_;
  OpenFile lock_;
};

}  // namespace cellcrush::store

#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "store/data_folder.h"
#include "store/journal.h"
#include "store/journal_reader.h"
#include "store/sweep_reader.h"

namespace cellcrush::jobs {

/// Deletes ended jobs and sweeps with all their data. Thread-safe. A folder that cannot be removed is left for
/// finish_deletions.
class Deletion {
 public:
  /// All of it outlives this object.
  struct Parts {
    const store::DataFolder& folder;
    store::Journal& journal;
    store::JournalReader& reader;
    store::SweepReader& sweeps;
  };

  explicit Deletion(const Parts& parts) : parts_(parts) {}

  /// Throws ServiceError: not_found, or failed_precondition if the job has not ended.
  void delete_job(std::int64_t job) const;

  /// Deletes the ended ones among the jobs, in batches.
  void delete_jobs(const std::vector<std::int64_t>& jobs) const;

  /// Deletes a sweep with its jobs. The sweep disappears at once; its jobs follow in transactions of bounded size, and
  /// finish_sweeps completes what a killed daemon left. Throws ServiceError: not_found, failed_precondition naming jobs
  /// that have not ended, or cancelled once `given_up` returns true.
  void delete_sweep(std::int64_t sweep, const std::function<bool()>& given_up) const;

  /// Completes the deletion of sweeps, and deletes those whose creation was interrupted. Returns early once `given_up`
  /// returns true.
  void finish_sweeps(const std::function<bool()>& given_up) const;

  /// Removes folders that earlier deletions left behind.
  void finish_folders() const;

 private:
  /// Whether it completed.
  bool remove_sweep(std::int64_t sweep, const std::function<bool()>& given_up) const;
  void remove_folders(const std::vector<std::int64_t>& jobs) const;

  Parts parts_;
};

}  // namespace cellcrush::jobs

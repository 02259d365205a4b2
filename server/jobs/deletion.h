#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "store/data_folder.h"
#include "store/journal.h"
#include "store/journal_reader.h"
#include "store/sweep_reader.h"

namespace cellcrush::jobs {

/// Deletes what has ended, with all it left. Thread-safe. A folder that cannot be removed is left to finish_deletions.
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

  /// Throws ServiceError: not_found, or failed_precondition when it has not ended.
  void delete_job(std::int64_t job) const;

  /// Deletes those of the jobs that have ended, some at a time.
  void delete_jobs(const std::vector<std::int64_t>& jobs) const;

  /// Deletes a sweep with its jobs. Nobody finds the sweep any more as soon as that begins; its jobs go in transactions
  /// of a bounded size, and finish_sweeps continues what a killed daemon left. Throws ServiceError: not_found,
  /// failed_precondition, which names jobs that have not ended, or cancelled once `given_up` says that nobody waits any
  /// more.
  void delete_sweep(std::int64_t sweep, const std::function<bool()>& given_up) const;

  /// Deletes what is left of sweeps whose deletion has begun. Ends early once `given_up` says so.
  void finish_sweeps(const std::function<bool()>& given_up) const;

  /// Removes the folders that earlier deletions left behind.
  void finish_folders() const;

 private:
  /// Whether it came to the end.
  bool remove_sweep(std::int64_t sweep, const std::function<bool()>& given_up) const;
  void remove_folders(const std::vector<std::int64_t>& jobs) const;

  Parts parts_;
};

}  // namespace cellcrush::jobs

#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
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

/// Deletes ended jobs that are too old or too many, oldest first. A sweep is kept or deleted as a whole and ends with
/// its last job. Ages follow the service clock (store::ServiceClock). Therefore neither a wrong wall clock nor time
/// without a daemon ages anything. Not thread-safe.
class Retention {
 public:
  /// 0: no limit, for each.
  struct Limits {
    std::chrono::seconds age{0};  ///< since the end
    std::int64_t count = 0;       ///< ended jobs
    std::int64_t bytes = 0;       ///< results and journal rows
  };

  /// `parts` and `deletion` outlive this object.
  Retention(const Deletion::Parts& parts, const Deletion& deletion, const Limits& limits)
      : parts_(parts), deletion_(deletion), limits_(limits) {}

  /// Records the size of newly ended jobs, in batches. Returns early once `given_up` returns true.
  void measure(const std::function<bool()>& given_up) const;

  /// Deletes what exceeds a limit, at most about a thousand jobs; whether there may be more. Returns early once
  /// `given_up` returns true.
  bool enforce(const std::function<bool()>& given_up);

 private:
  [[nodiscard]] bool has_limit() const { return limits_.age.count() > 0 || limits_.count > 0 || limits_.bytes > 0; }
  [[nodiscard]] bool is_too_much(const store::EndedTotals& totals) const;
  [[nodiscard]] bool is_old(std::int64_t ended_at) const;
  /// The end of a job's sweep, looked up once per pass.
  const store::SweepEnd& end_of(std::int64_t sweep);
  void delete_sweep(std::int64_t sweep, const std::function<bool()>& given_up) const;

  Deletion::Parts parts_;
  const Deletion& deletion_;
  Limits limits_;
  std::map<std::int64_t, store::SweepEnd> sweeps_;  ///< seen in this pass
};

}  // namespace cellcrush::jobs

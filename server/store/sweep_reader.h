#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "cellcrush/v1/sweep.pb.h"
#include "mutex.h"
#include "store/page_room.h"
#include "store/queued_job.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// Consecutive rows of a sweep's table.
struct StoredRows {
  std::vector<v1::SweepTable::Row> rows;
  std::int64_t last_point = 0;  ///< of the last row, counted from 1; 0 if there is none
  bool has_more = false;        ///< whether more follow
};

/// Reads the journal's sweeps beside its writer; sees committed data. Thread-safe. Failures throw ServiceError.
class SweepReader {
 public:
  /// REQUIRES: a Journal was opened on the same path.
  explicit SweepReader(const std::filesystem::path& path);

  /// A sweep of 100,000 jobs is found at once without them.
  enum class Jobs : std::uint8_t { listed, left_out };

  /// The sweep with its name, its jobs in the order of the points, and the number in each state. Nothing for a hidden
  /// one; only the name, without a create_time, of a damaged one.
  std::optional<v1::Sweep> find_sweep(std::int64_t sweep, Jobs jobs = Jobs::listed);

  /// Numbers below `before`, newest first.
  std::vector<std::int64_t> list_sweeps(std::int64_t before, int limit);

  /// Totals of the sweep's jobs.
  SweepEnd end_of(std::int64_t sweep);

  /// A job of the sweep that has not ended; nothing if all have.
  std::optional<std::int64_t> find_unended(std::int64_t sweep);

  /// Its job with the highest number, which a retry raises; 0 without one.
  std::int64_t newest_job(std::int64_t sweep);

  /// Sweeps that Journal::begin_sweep_deletion has hidden.
  std::vector<std::int64_t> sweeps_in_deletion();

  /// The sweep's jobs in the order of the points, even if it is hidden.
  std::vector<std::int64_t> jobs_of(std::int64_t sweep);

  /// One row per job in the order of the points, starting after point `after`; results lack case and labels.
  /// Throws ServiceError (data_loss) for a damaged point.
  StoredRows rows(std::int64_t sweep, std::int64_t after = 0, PageRoom room = {});

 private:
  Mutex mutex_;
  Database database_ CELLCRUSH_GUARDED_BY(mutex_);
};

}  // namespace cellcrush::store

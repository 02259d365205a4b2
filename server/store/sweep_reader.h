#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <vector>

#include "cellcrush/v1/sweep.pb.h"
#include "mutex.h"
#include "store/ended_job.h"
#include "store/page_room.h"
#include "store/sqlite.h"

namespace cellcrush::store {

/// Rows of a sweep's table that follow each other.
struct StoredRows {
  std::vector<v1::SweepTable::Row> rows;
  std::int64_t last_point = 0;  ///< of the last of them, counted from 1; 0 without any
  bool has_more = false;        ///< whether others come behind them
};

/// Reads the journal's sweeps beside its writer; sees what is committed. Thread-safe. Failures throw ServiceError.
class SweepReader {
 public:
  /// REQUIRES: a Journal has been opened on the same path.
  explicit SweepReader(const std::filesystem::path& path);

  /// With its name, its jobs in the order of the points, and how many are in each state. Nothing of one that is hidden.
  std::optional<v1::Sweep> find_sweep(std::int64_t sweep);

  /// Numbers below `before`, newest first.
  std::vector<std::int64_t> list_sweeps(std::int64_t before, int limit);

  /// The sweep's jobs together.
  SweepEnd end_of(std::int64_t sweep);

  /// Sweeps that Journal::begin_sweep_deletion has hidden.
  std::vector<std::int64_t> sweeps_in_deletion();

  /// The sweep's jobs in the order of the points, also of a hidden one.
  std::vector<std::int64_t> jobs_of(std::int64_t sweep);

  /// A row a job in the order of the points, from behind the point `after`; of each result the case and the labels are
  /// left out.
  StoredRows rows(std::int64_t sweep, std::int64_t after = 0, PageRoom room = {});

 private:
  Mutex mutex_;
  Database database_ CELLCRUSH_GUARDED_BY(mutex_);
};

}  // namespace cellcrush::store

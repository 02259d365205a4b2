#pragma once

#include <cstdint>
#include <string>

namespace cellcrush::store {

/// Name of the executor on the daemon's machine, and the one of jobs of earlier versions.
inline constexpr const char* kLocalExecutor = "local";

/// What the journal's column `executor` holds for it.
inline std::string executor_column(const std::string& executor) { return executor == kLocalExecutor ? "" : executor; }

/// What decides where and when a waiting job starts, and how long it runs.
struct QueuedJob {
  std::int64_t job = 0;
  std::int64_t submission = 0;  ///< first job submitted together with it: itself, unless in a sweep
  int priority = 0;
  std::int64_t element_steps = 0;  ///< of the reference crush, which take as long as the run; 0: unknown
  std::int64_t sweep = 0;          ///< 0: no sweep
  int max_parallel = 0;            ///< jobs of the sweep that run at once; 0: no limit
  std::string owner{};             ///< empty: from an earlier version, whose jobs count as one owner's
  std::string executor = kLocalExecutor;
};

/// An ended job, as retention sees it.
struct EndedJob {
  std::int64_t job = 0;
  std::int64_t ended_at = 0;  ///< second of the service clock
  std::int64_t bytes = 0;     ///< result and journal rows
  std::int64_t sweep = 0;     ///< 0: none
};

/// Totals of ended jobs.
struct EndedTotals {
  std::int64_t count = 0;  ///< jobs
  std::int64_t bytes = 0;  ///< results and journal rows
};

/// The jobs of one sweep together, as retention sees them.
struct SweepEnd {
  EndedTotals totals;
  std::int64_t ended_at = 0;  ///< of the last job to end
  bool has_ended = false;     ///< whether all have ended
};

}  // namespace cellcrush::store

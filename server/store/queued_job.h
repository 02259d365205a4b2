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
  std::int64_t element_steps = 0;  ///< elements times steps of the run; 0: unknown
  std::int64_t sweep = 0;          ///< 0: no sweep
  int max_parallel = 0;            ///< jobs of the sweep that run at once; 0: no limit
  std::string owner{};             ///< empty: from an earlier version, whose jobs count as one owner's
  std::string executor = kLocalExecutor;
};

}  // namespace cellcrush::store

#pragma once

#include <cstdint>
#include <string>

namespace cellcrush::store {

/// What decides when a waiting job starts, and how long it runs.
struct QueuedJob {
  std::int64_t job = 0;
  std::int64_t submission = 0;  ///< first job submitted together with it: itself, unless in a sweep
  int priority = 0;
  std::int64_t element_steps = 0;  ///< elements times steps of the run; 0: unknown
  std::int64_t sweep = 0;          ///< 0: no sweep
  int max_parallel = 0;            ///< jobs of the sweep that run at once; 0: no limit
  std::string owner{};             ///< empty: from an earlier version, whose jobs count as one owner's
};

}  // namespace cellcrush::store

#pragma once

#include <cstdint>
#include <string>

namespace cellcrush::store {

/// What decides when a job that waits starts, and how long it runs.
struct QueuedJob {
  std::int64_t job = 0;
  std::int64_t submission = 0;  ///< the first job that was submitted together with it: itself, unless in a sweep
  int priority = 0;
  std::int64_t element_steps = 0;  ///< elements times steps of its run; 0: unknown
  std::int64_t sweep = 0;          ///< 0: none
  int max_parallel = 0;            ///< jobs of the sweep that run at once; 0: any number
  std::string owner{};             ///< empty: of an earlier version, whose jobs count as one owner's
};

}  // namespace cellcrush::store

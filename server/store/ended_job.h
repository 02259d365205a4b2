#pragma once

#include <cstdint>

namespace cellcrush::store {

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

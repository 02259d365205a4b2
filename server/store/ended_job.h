#pragma once

#include <cstdint>

namespace cellcrush::store {

/// A job that has ended, as retention sees it.
struct EndedJob {
  std::int64_t job = 0;
  std::int64_t ended_at = 0;  ///< second of the service clock
  std::int64_t bytes = 0;     ///< of its result and its rows in the journal
  std::int64_t sweep = 0;     ///< 0: none
};

/// How much has ended.
struct EndedTotals {
  std::int64_t count = 0;  ///< jobs
  std::int64_t bytes = 0;  ///< of their results and their rows in the journal
};

/// The jobs of a sweep, as retention sees them: together.
struct SweepEnd {
  EndedTotals totals;
  std::int64_t ended_at = 0;  ///< of the job that ended last
  bool has_ended = false;     ///< whether all of them have
};

}  // namespace cellcrush::store

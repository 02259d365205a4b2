#pragma once

#include <cstdint>
#include <map>

#include "mutex.h"

namespace cellcrush::jobs {

/// Counts how often in a row the workers of a job were lost without getting further than their predecessors.
/// Thread-safe.
class LossCount {
 public:
  static constexpr int kMost = 3;

  /// Adds a loss; `step` is that of the newest sample. Whether the job may be retried; if not, its count is forgotten.
  bool may_retry(std::int64_t job, std::int64_t step) {
    const MutexLock lock(mutex_);
    Losses& losses = losses_[job];
    if (step > losses.step) losses = {0, step};
    if (++losses.count < kMost) return true;
    losses_.erase(job);
    return false;
  }

  void forget(std::int64_t job) {
    const MutexLock lock(mutex_);
    losses_.erase(job);
  }

 private:
  struct Losses {
    int count = 0;
    std::int64_t step = -1;  ///< of the newest sample at the last loss
  };

  Mutex mutex_;
  std::map<std::int64_t, Losses> losses_ CELLCRUSH_GUARDED_BY(mutex_);
};

}  // namespace cellcrush::jobs

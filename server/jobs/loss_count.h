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

  /// Adds a loss; `samples`: how many the job has. Whether the job may be retried; if not, its count is forgotten.
  bool may_retry(std::int64_t job, std::int64_t samples) {
    const MutexLock lock(mutex_);
    Losses& losses = losses_[job];
    if (samples > losses.samples) losses = {0, samples};
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
    std::int64_t samples = 0;  ///< at the last loss
  };

  Mutex mutex_;
  std::map<std::int64_t, Losses> losses_ CELLCRUSH_GUARDED_BY(mutex_);
};

}  // namespace cellcrush::jobs

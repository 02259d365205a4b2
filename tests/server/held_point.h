#pragma once

#include <atomic>
#include <chrono>
#include <semaphore>

namespace cellcrush::testing {

/// A point at which one thread stands until the test lets it pass. For one use.
class HeldPoint {
 public:
  /// Stands here; the first time only.
  void stand() {
    if (used_.exchange(true)) return;
    reached_.release();
    open_.acquire();
  }
  /// Waits until a thread stands here, at most 30 s.
  [[nodiscard]] bool wait() { return reached_.try_acquire_for(std::chrono::seconds(30)); }
  void open() { open_.release(); }

 private:
  std::atomic<bool> used_ = false;
  std::binary_semaphore reached_{0};
  std::binary_semaphore open_{0};
};

}  // namespace cellcrush::testing

#pragma once

#include <chrono>
#include <cstdint>

#include "clocks.h"

namespace cellcrush::store {

/// Seconds during which daemons have served a journal. It advances with the machine's uptime while a daemon serves, and
/// stands still otherwise. The wall clock does not affect it, so that a wrong clock makes nothing old. Thread-safe.
class ServiceClock {
 public:
  /// `before`: seconds counted by earlier daemons.
  ServiceClock(std::int64_t before, Clocks::Source uptime)
      : before_(before), uptime_(std::move(uptime)), start_(uptime_()) {}

  [[nodiscard]] std::int64_t seconds() const {
    return before_ + std::chrono::duration_cast<std::chrono::seconds>(uptime_() - start_).count();
  }

 private:
  std::int64_t before_;
  Clocks::Source uptime_;
  std::chrono::nanoseconds start_;
};

}  // namespace cellcrush::store

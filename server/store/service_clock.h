#pragma once

#include <chrono>
#include <cstdint>

#include "clocks.h"

namespace cellcrush::store {

/// Seconds for which daemons have served a journal: runs on while one serves, by the machine's uptime, and stands still
/// while none does. The wall clock does not move it, so that a clock that is set wrong makes nothing old. Thread-safe.
class ServiceClock {
 public:
  /// `before`: seconds served by earlier daemons.
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

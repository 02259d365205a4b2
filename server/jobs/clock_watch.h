#pragma once

#include <chrono>
#include <optional>

#include "clocks.h"

namespace cellcrush::jobs {

/// Detects a change of the wall clock: it then advances differently from the machine's uptime. Not thread-safe.
class ClockWatch {
 public:
  explicit ClockWatch(Clocks clocks) : clocks_(std::move(clocks)), offset_(clocks_.wall() - clocks_.uptime()) {}

  /// How far the wall clock was set since the last call, positive forward. Nothing below kLeastJump, which the gradual
  /// corrections of a synchronized clock never reach.
  std::optional<std::chrono::nanoseconds> find_jump() {
    const auto offset = clocks_.wall() - clocks_.uptime();
    const auto jump = offset - offset_;
    offset_ = offset;
    if (std::chrono::abs(jump) < kLeastJump) return std::nullopt;
    return jump;
  }

  static constexpr std::chrono::seconds kLeastJump{10};

 private:
  Clocks clocks_;
  std::chrono::nanoseconds offset_;
};

}  // namespace cellcrush::jobs

#pragma once

#include <google/protobuf/util/time_util.h>

#include <chrono>
#include <ctime>
#include <functional>

namespace cellcrush {

/// The clocks of the daemon, replaceable in tests. Both are thread-safe.
struct Clocks {
  using Source = std::function<std::chrono::nanoseconds()>;

  /// Reads a kernel clock.
  static std::chrono::nanoseconds read(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return std::chrono::seconds(now.tv_sec) + std::chrono::nanoseconds(now.tv_nsec);
  }

  Source wall = [] { return read(CLOCK_REALTIME); };    ///< since 1970; may be set forward and back
  Source uptime = [] { return read(CLOCK_BOOTTIME); };  ///< since boot, including suspension
};

/// The time to a microsecond. That of protobuf has whole seconds.
inline google::protobuf::Timestamp time_now() {
  const auto now = std::chrono::duration_cast<std::chrono::microseconds>(Clocks::read(CLOCK_REALTIME));
  return google::protobuf::util::TimeUtil::MicrosecondsToTimestamp(now.count());
}

}  // namespace cellcrush

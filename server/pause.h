#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>

namespace cellcrush {

/// Waits for `time`, or until a stop is requested. Returns false if one is.
inline bool pause_unless_stopped(const std::stop_token& stop, std::chrono::milliseconds time) {
  std::mutex never_shared;
  std::condition_variable_any sleep;
  std::unique_lock lock(never_shared);
  sleep.wait_for(lock, stop, time, [] { return false; });
  return !stop.stop_requested();
}

}  // namespace cellcrush

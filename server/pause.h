#pragma once

#include <chrono>
#include <stop_token>

namespace cellcrush {

/// Waits for `time`, or until a stop is requested. Returns false if one is.
bool pause_unless_stopped(const std::stop_token& stop, std::chrono::milliseconds time);

}  // namespace cellcrush

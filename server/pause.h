#pragma once

#include <chrono>
#include <stop_token>

namespace cellcrush {

/// Waits so long, or until a stop is requested. False when it is.
bool pause_unless_stopped(const std::stop_token& stop, std::chrono::milliseconds time);

}  // namespace cellcrush

#pragma once

#include <string>

namespace cellcrush::rpc {

/// Logs that a call which changes something was accepted: "jobs/12 made by anna, request \"night 3\"". `name` is the
/// job or sweep, or empty for the daemon; `request_id` is the caller's, or empty.
void log_change(const std::string& name, const std::string& done, const std::string& caller,
                const std::string& request_id = "");

}  // namespace cellcrush::rpc

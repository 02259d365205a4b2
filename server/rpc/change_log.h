#pragma once

#include <string>

namespace cellcrush::rpc {

/// Notes in the log that a call to change something was accepted: "jobs/12 made by anna, request \"night 3\"".
/// `name` is that of the job or sweep, or empty for the daemon; `request_id` is as the caller gave it, or empty.
void log_change(const std::string& name, const std::string& done, const std::string& caller,
                const std::string& request_id = "");

}  // namespace cellcrush::rpc

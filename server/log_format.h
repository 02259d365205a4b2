#pragma once

#include <spdlog/formatter.h>

#include <memory>

namespace cellcrush {

/// A JSON object a line: time (UTC, ISO 8601), level, message, and the name of the job that the message begins with, if it does.
std::unique_ptr<spdlog::formatter> make_json_formatter();

}  // namespace cellcrush

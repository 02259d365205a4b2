#pragma once

#include <spdlog/formatter.h>

#include <memory>

namespace cellcrush {

/// spdlog's own lines; control characters and what is not UTF-8 are escaped in a message, so that a message is a line
/// of text.
std::unique_ptr<spdlog::formatter> make_text_formatter();

/// A JSON object a line: time (UTC, ISO 8601), level, the line's fields (log_fields.h) and message. A line without
/// fields has the name of the job that its message begins with, if it does.
std::unique_ptr<spdlog::formatter> make_json_formatter();

}  // namespace cellcrush

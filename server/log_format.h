#pragma once

#include <spdlog/formatter.h>

#include <memory>

namespace cellcrush {

/// spdlog's default format. Control characters and invalid UTF-8 in a message are escaped, so that a message stays one
/// line.
std::unique_ptr<spdlog::formatter> make_text_formatter();

/// One JSON object per line: time (UTC, ISO 8601), level, the line's fields (log_fields.h) and the message. For a line
/// without fields, the job is taken from the start of its message, if it names one.
std::unique_ptr<spdlog::formatter> make_json_formatter();

}  // namespace cellcrush

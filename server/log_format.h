#pragma once

#include <spdlog/common.h>
#include <spdlog/formatter.h>

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace cellcrush {

/// The local time with its zone, the program, the level and the message, which is printable().
std::unique_ptr<spdlog::formatter> make_text_formatter();

/// One JSON object per line: time (UTC, ISO 8601), level, the line's fields and the message. For a line
/// without fields, the job is taken from the start of its message, if it names one.
std::unique_ptr<spdlog::formatter> make_json_formatter();

/// A structured field of a log line. In the JSON form it is a key of its own (make_json_formatter).
struct LogField {
  std::string_view key;
  std::string value;  ///< empty: the line lacks this field
};

/// Writes a line with its fields to the default logger, which must write on the calling thread. Field values may come
/// from a caller; `words` must contain whatever the text form should show of them.
void log_with_fields(spdlog::level::level_enum level, const std::string& words, const std::vector<LogField>& fields);

/// The text with control characters, those that change the direction of text, and invalid UTF-8 as bytes \xNN.
std::string printable(std::string_view text);

/// The same for a text of several lines.
std::string printable_lines(const std::string& text);

/// The text in quotes, as in JSON. An invalid byte is written as its number.
std::string json_string(std::string_view text);

}  // namespace cellcrush

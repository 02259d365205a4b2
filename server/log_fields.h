#pragma once

#include <spdlog/common.h>

#include <string>
#include <string_view>
#include <vector>

namespace cellcrush {

/// A structured field of a log line. In the JSON form it is a key of its own (log_format.h).
struct LogField {
  std::string_view key;
  std::string value;  ///< empty: the line lacks this field
};

/// Writes a line with its fields to the default logger, which must write on the calling thread. Field values may come
/// from a caller; `words` must contain whatever the text form should show of them.
void log_with_fields(spdlog::level::level_enum level, const std::string& words, const std::vector<LogField>& fields);

/// The fields of the line that this thread is writing; empty for a line without any.
const std::vector<LogField>& fields_of_this_line();

}  // namespace cellcrush

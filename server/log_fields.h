#pragma once

#include <spdlog/common.h>

#include <string>
#include <string_view>
#include <vector>

namespace cellcrush {

/// What a line of the log is about, beside its words: in the JSON form a key of its own (log_format.h).
struct LogField {
  std::string_view key;
  std::string value;  ///< empty: the line does not have it
};

/// Writes a line with its fields to the default logger, which must write on the thread that logs. Their values may be
/// anything that a caller gave; the words hold what the text form is to tell of them.
void log_with_fields(spdlog::level::level_enum level, const std::string& words, const std::vector<LogField>& fields);

/// Those of the line that this thread writes now; empty for a line without any.
const std::vector<LogField>& fields_of_this_line();

}  // namespace cellcrush

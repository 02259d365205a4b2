#include "log_fields.h"

#include <spdlog/spdlog.h>

namespace cellcrush {
namespace {

// A formatter receives only the message, so a thread-local passes the fields; it runs on the logging thread.
thread_local const std::vector<LogField>* current_fields = nullptr;

}  // namespace

void log_with_fields(spdlog::level::level_enum level, const std::string& words, const std::vector<LogField>& fields) {
  current_fields = &fields;
  // The message is not a format string. spdlog handles write errors itself and does not throw.
  spdlog::log(level, spdlog::string_view_t(words));
  current_fields = nullptr;
}

const std::vector<LogField>& fields_of_this_line() {
  static const std::vector<LogField> kNone;
  return current_fields == nullptr ? kNone : *current_fields;
}

}  // namespace cellcrush

#include "log_format.h"

#include <absl/strings/str_join.h>
#include <absl/strings/str_split.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <spdlog/details/log_msg.h>
#include <spdlog/pattern_formatter.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <iterator>

namespace cellcrush {
namespace {

// Length of the character at the start of the text; 0 if it is not valid UTF-8.
std::size_t character_length(std::string_view text) {
  const auto byte = [text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (byte(0) < 0x80U) return 1;
  const std::size_t length = byte(0) < 0xc2U ? 0 : byte(0) < 0xe0U ? 2 : byte(0) < 0xf0U ? 3 : byte(0) < 0xf5U ? 4 : 0;
  if (length == 0 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xc0U) != 0x80U) return 0;
  }
  // Overlong, a surrogate, or beyond the last code point.
  const unsigned head = 256U * byte(0) + byte(1);
  const bool is_none = (head >= 0xe080U && head < 0xe0a0U) || (head >= 0xeda0U && head < 0xee00U) ||
                       (head >= 0xf080U && head < 0xf090U) || (head >= 0xf490U && head < 0xf500U);
  return is_none ? 0 : length;
}

// Whether a terminal may interpret the character as a command (ASCII controls, U+0080 to U+009F), or it changes the
// direction of the text beside it (U+061C, U+200E, U+200F, U+202A to U+202E, U+2066 to U+2069).
bool is_control(std::string_view character) {
  const auto byte = [character](std::size_t i) { return static_cast<unsigned char>(character[i]); };
  if (byte(0) < 0x20U || byte(0) == 0x7fU) return true;
  if (character.size() == 2) return (byte(0) == 0xc2U && byte(1) < 0xa0U) || character == "\u061c";
  return character == "\u200e" || character == "\u200f" || (character >= "\u202a" && character <= "\u202e") ||
         (character >= "\u2066" && character <= "\u2069");
}

// Calls show(character) for each printable character, and escape(byte) for each other byte.
template <class Show, class Escape>
void visit_characters(std::string_view text, const Show& show, const Escape& escape) {
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(1, length));
    if (length > 0 && !is_control(character)) {
      show(character);
    } else {
      for (const char byte : character) escape(static_cast<unsigned char>(byte));
    }
    text.remove_prefix(character.size());
  }
}

// A formatter receives only the message, so a thread-local passes the fields; it runs on the logging thread.
thread_local const std::vector<LogField>* current_fields = nullptr;

// "jobs/12" of "jobs/12 runs in process 7".
std::string_view job_of(std::string_view message) {
  if (!message.starts_with("jobs/")) return {};
  return message.substr(0, message.find_first_of(": "));
}

class JsonFormatter final : public spdlog::formatter {
 public:
  void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& line) override {
    const std::string_view text(message.payload.data(), message.payload.size());
    const auto level = spdlog::level::to_string_view(message.level);
    const auto milliseconds = std::chrono::floor<std::chrono::milliseconds>(message.time);
    const auto seconds = std::chrono::floor<std::chrono::seconds>(milliseconds);
    auto out = std::back_inserter(line);
    fmt::format_to(out, "{{\"time\":\"{:%Y-%m-%dT%H:%M:%S}.{:03}Z\",\"level\":\"{}\"", fmt::gmtime(seconds),
                   (milliseconds - seconds).count(), std::string_view(level.data(), level.size()));
    const auto add = [&out](std::string_view key, std::string_view value) {
      if (!value.empty()) fmt::format_to(out, ",\"{}\":{}", key, json_string(value));
    };
    if (current_fields == nullptr || current_fields->empty()) add("job", job_of(text));
    if (current_fields != nullptr) {
      for (const auto& field : *current_fields) add(field.key, field.value);
    }
    fmt::format_to(out, ",\"message\":{}}}\n", json_string(text));
  }

  [[nodiscard]] std::unique_ptr<spdlog::formatter> clone() const override { return make_json_formatter(); }
};

// The local time with its zone, the program, the level. A message may contain a caller's text, which must not look like
// a line of the daemon.
class TextFormatter final : public spdlog::formatter {
 public:
  void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& line) override {
    const std::string text = printable({message.payload.data(), message.payload.size()});
    spdlog::details::log_msg shown = message;
    shown.payload = text;
    form_.format(shown, line);
    message.color_range_start = shown.color_range_start;
    message.color_range_end = shown.color_range_end;
  }

  [[nodiscard]] std::unique_ptr<spdlog::formatter> clone() const override { return make_text_formatter(); }

 private:
  spdlog::pattern_formatter form_{"[%Y-%m-%d %H:%M:%S.%e %z] [%n] [%^%l%$] %v"};
};

}  // namespace

std::string printable(std::string_view text) {
  std::string out;
  visit_characters(
      text, [&out](std::string_view character) { out += character; },
      [&out](unsigned char byte) { out += fmt::format("\\x{:02x}", byte); });
  return out;
}

std::string printable_lines(const std::string& text) {
  const std::vector<std::string> lines = absl::StrSplit(text, '\n');
  return absl::StrJoin(lines, "\n", [](std::string* out, const std::string& line) { *out += printable(line); });
}

std::string json_string(std::string_view text) {
  std::string out = "\"";
  visit_characters(
      text,
      [&out](std::string_view character) {
        if (character == "\"" || character == "\\") out.push_back('\\');
        out += character;
      },
      // JSON cannot hold bytes: an invalid byte is written as its number in text, as in the text form.
      [&out](unsigned char byte) {
        out += byte < 0x80U ? fmt::format("\\u{:04x}", byte) : fmt::format("\\\\x{:02x}", byte);
      });
  return out + "\"";
}

void log_with_fields(spdlog::level::level_enum level, const std::string& words, const std::vector<LogField>& fields) {
  current_fields = &fields;
  // The message is not a format string. spdlog handles write errors itself and does not throw.
  spdlog::log(level, spdlog::string_view_t(words));
  current_fields = nullptr;
}

std::unique_ptr<spdlog::formatter> make_text_formatter() { return std::make_unique<TextFormatter>(); }

std::unique_ptr<spdlog::formatter> make_json_formatter() { return std::make_unique<JsonFormatter>(); }

}  // namespace cellcrush

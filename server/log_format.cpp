#include "log_format.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <spdlog/details/log_msg.h>
#include <spdlog/pattern_formatter.h>

#include <iterator>
#include <string_view>

#include "log_fields.h"

namespace cellcrush {
namespace {

std::string json_string(std::string_view text) {
  std::string out = "\"";
  for (const char character : text) {
    const auto byte = static_cast<unsigned char>(character);
    if (character == '"' || character == '\\') out.push_back('\\');
    if (byte < 0x20U) {
      out += fmt::format("\\u{:04x}", byte);
    } else {
      out.push_back(character);
    }
  }
  return out + "\"";
}

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
    const auto& fields = fields_of_this_line();
    if (fields.empty()) add("job", job_of(text));
    for (const auto& field : fields) add(field.key, field.value);
    fmt::format_to(out, ",\"message\":{}}}\n", json_string(text));
  }

  [[nodiscard]] std::unique_ptr<spdlog::formatter> clone() const override { return make_json_formatter(); }
};

// spdlog's own form. What a caller gave may stand in a message, and a line of it is not to be taken for one of the
// daemon's.
class TextFormatter final : public spdlog::formatter {
 public:
  void format(const spdlog::details::log_msg& message, spdlog::memory_buf_t& line) override {
    std::string text;
    for (const char character : std::string_view(message.payload.data(), message.payload.size())) {
      const auto byte = static_cast<unsigned char>(character);
      if (byte < 0x20U || byte == 0x7fU) {
        text += fmt::format("\\x{:02x}", byte);
      } else {
        text.push_back(character);
      }
    }
    spdlog::details::log_msg shown = message;
    shown.payload = text;
    form_.format(shown, line);
    message.color_range_start = shown.color_range_start;
    message.color_range_end = shown.color_range_end;
  }

  [[nodiscard]] std::unique_ptr<spdlog::formatter> clone() const override { return make_text_formatter(); }

 private:
  spdlog::pattern_formatter form_;
};

}  // namespace

std::unique_ptr<spdlog::formatter> make_text_formatter() { return std::make_unique<TextFormatter>(); }

std::unique_ptr<spdlog::formatter> make_json_formatter() { return std::make_unique<JsonFormatter>(); }

}  // namespace cellcrush

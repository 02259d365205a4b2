#include "terminal/terminal.h"

#include <fmt/format.h>
#include <google/protobuf/struct.pb.h>
#include <google/protobuf/util/json_util.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

namespace cellcrush::client {

namespace {

std::string_view variable_of(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string_view() : std::string_view(value);
}

bool locale_is_utf8() {
  for (const char* name : {"LC_ALL", "LC_CTYPE", "LANG"}) {
    const std::string_view value = variable_of(name);
    if (value.empty()) continue;
    return value.find("UTF-8") != std::string_view::npos || value.find("utf8") != std::string_view::npos;
  }
  return false;
}

// All zeros if the standard output is not a terminal.
winsize window_size() {
  winsize size = {};
  return ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 ? size : winsize{};
}

}  // namespace

Terminal find_terminal() {
  Terminal terminal;
  const std::string_view kind = variable_of("TERM");
  terminal.interactive = isatty(STDOUT_FILENO) == 1 && !kind.empty() && kind != "dumb";
  terminal.colour = terminal.interactive && variable_of("NO_COLOR").empty();
  terminal.unicode = locale_is_utf8();
  return terminal;
}

int terminal_width() {
  constexpr int kDefault = 80;
  if (const int columns = window_size().ws_col; columns > 0) return columns;
  const int columns = std::atoi(std::string(variable_of("COLUMNS")).c_str());
  return columns > 0 ? columns : kDefault;
}

int terminal_height() {
  const int lines = window_size().ws_row;
  return lines == 0 ? 24 : lines;
}

void Redraw::show(const std::vector<std::string>& lines) {
  std::string text = lines_ > 0 ? fmt::format("\x1b[{}A\r", lines_) : "\r";
  for (const std::string& line : lines) text += line + "\x1b[K\n";
  text += "\x1b[J";
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
  lines_ = static_cast<int>(lines.size());
}

std::string json_text(const google::protobuf::Message& message) {
  google::protobuf::util::JsonPrintOptions options;
  options.preserve_proto_field_names = true;
  options.always_print_primitive_fields = true;
  std::string text;
  const auto status = google::protobuf::util::MessageToJsonString(message, &text, options);
  if (!status.ok()) throw std::runtime_error("a message of the server has no JSON form: " + status.ToString());
  // protobuf escapes the older ones of the characters that change the direction of text.
  constexpr std::array<std::pair<std::string_view, const char*>, 5> kNewer = {{{"\u061c", "\\u061c"},
                                                                               {"\u2066", "\\u2066"},
                                                                               {"\u2067", "\\u2067"},
                                                                               {"\u2068", "\\u2068"},
                                                                               {"\u2069", "\\u2069"}}};
  for (const auto& [character, escape] : kNewer) {
    for (std::size_t at = 0; (at = text.find(character, at)) != std::string::npos;)
      text.replace(at, character.size(), escape);
  }
  return text;
}

void print_json(const google::protobuf::Message& message) {
  fmt::print("{}\n", json_text(message));
  std::fflush(stdout);
}

void print_file_json(const std::string& path, const std::map<std::string, int>& counts) {
  google::protobuf::Struct json;
  (*json.mutable_fields())["path"].set_string_value(path);
  for (const auto& [name, count] : counts) (*json.mutable_fields())[name].set_number_value(count);
  print_json(json);
}

}  // namespace cellcrush::client

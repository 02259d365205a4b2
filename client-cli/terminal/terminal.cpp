#include "terminal/terminal.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

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

}  // namespace cellcrush::client

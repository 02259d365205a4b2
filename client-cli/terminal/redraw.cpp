#include "terminal/redraw.h"

#include <fmt/format.h>

#include <cstdio>

namespace cellcrush::client {

void Redraw::show(const std::vector<std::string>& lines) {
  std::string text = lines_ > 0 ? fmt::format("\x1b[{}A\r", lines_) : "\r";
  for (const std::string& line : lines) text += line + "\x1b[K\n";
  text += "\x1b[J";
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
  lines_ = static_cast<int>(lines.size());
}

}  // namespace cellcrush::client

#include "help/wrapped_text.h"

#include "chart/display_text.h"

namespace cellcrush::client {

std::string wrap_text(std::string_view text, int width) {
  std::string out;
  for (;;) {
    const std::size_t end = text.find('\n');
    std::string_view separator;
    for (const std::string& line : wrap_words(text.substr(0, end), width)) {
      out.append(separator).append(line);
      separator = "\n";
    }
    if (end == std::string_view::npos) return out;
    out += '\n';
    text.remove_prefix(end + 1);
  }
}

}  // namespace cellcrush::client

#pragma once

#include <string>
#include <string_view>

namespace cellcrush::client {

/// Wraps each line of the text to at most `width` columns, like wrap_words. Adds no newline at the end.
std::string wrap_text(std::string_view text, int width);

}  // namespace cellcrush::client

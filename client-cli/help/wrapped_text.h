#pragma once

#include <string>
#include <string_view>

namespace cellcrush::client {

/// Each line of the text in lines of at most `width` columns, as wrap_words breaks them. No newline is added at its
/// end.
std::string wrap_text(std::string_view text, int width);

}  // namespace cellcrush::client

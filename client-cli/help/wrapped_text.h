#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace cellcrush::client {

/// Text in lines of at most `width` characters, broken at spaces; a longer word has a line of its own. Newlines in the
/// text stay, and none is added at its end.
std::string wrap_text(std::string_view text, std::size_t width);

}  // namespace cellcrush::client

#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace cellcrush::client {

/// Text in lines of at most `width` characters, broken at spaces, without an end of line behind the last; a word that is
/// longer has a line of its own. Its own ends of lines stay.
std::string wrap_text(std::string_view text, std::size_t width);

}  // namespace cellcrush::client

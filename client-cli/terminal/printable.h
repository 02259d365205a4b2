#pragma once

#include <string>
#include <string_view>

namespace cellcrush::client {

/// `text` in which control characters other than line ends, and bytes that are not UTF-8, stand as escapes such as
/// \x1b, so that what comes from elsewhere cannot drive the terminal.
std::string printable(std::string_view text);

}  // namespace cellcrush::client

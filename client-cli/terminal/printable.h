#pragma once

#include <string>
#include <string_view>

namespace cellcrush::client {

/// `text` with control characters other than line ends, and invalid UTF-8, replaced by escapes such as \x1b, so that
/// untrusted text cannot control the terminal.
std::string printable(std::string_view text);

}  // namespace cellcrush::client

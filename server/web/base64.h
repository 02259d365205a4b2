#pragma once

#include <string>
#include <string_view>

namespace cellcrush::web {

/// With padding.
std::string base64_of(std::string_view bytes);

}  // namespace cellcrush::web

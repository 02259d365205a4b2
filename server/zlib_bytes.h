#pragma once

#include <string>
#include <string_view>

namespace cellcrush {

/// Bytes as a zlib stream (RFC 1950). Throws std::bad_alloc.
std::string zlib_of(std::string_view bytes);

}  // namespace cellcrush

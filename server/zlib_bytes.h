#pragma once

#include <string>
#include <string_view>

namespace cellcrush {

/// Bytes as a zlib stream (RFC 1950). Throws std::bad_alloc.
std::string zlib_of(std::string_view bytes);

/// Bytes as a gzip file (RFC 1952), as small as it gets. Throws std::bad_alloc.
std::string gzip_of(std::string_view bytes);

}  // namespace cellcrush

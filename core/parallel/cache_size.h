#pragma once

#include <cstddef>

namespace cellcrush {

/// Bytes of the last-level cache that a run may count on. At most 32 MB, as larger ones are shared by many cores; 32 MB
/// if the machine does not report a size. Affects speed only.
std::size_t last_cache_bytes();

}  // namespace cellcrush

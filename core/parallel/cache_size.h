#pragma once

#include <cstddef>

namespace cellcrush {

/// Bytes of the last cache of this machine; 32 MB where it does not say. Decides about speed only.
std::size_t last_cache_bytes();

}  // namespace cellcrush

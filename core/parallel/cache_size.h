#pragma once

#include <cstddef>

namespace cellcrush {

/// Bytes of the last cache of this machine that a run may count on: at most 32 MB, as larger ones are shared by many
/// cores; 32 MB where the machine does not say. Affects speed only.
std::size_t last_cache_bytes();

}  // namespace cellcrush

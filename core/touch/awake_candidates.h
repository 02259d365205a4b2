#pragma once

#include <cstddef>

#include "cellcrush/state.h"

namespace cellcrush {

/// Writes the indices of the awake candidates from `first` to `end`, which bound whole batches. Returns how many there
/// are. REQUIRES: `places` has room for all of them and kCandidateBatch more, which are overwritten.
std::size_t find_awake_candidates(const ContactLists& lists, std::size_t first, std::size_t end, int* places);

}  // namespace cellcrush

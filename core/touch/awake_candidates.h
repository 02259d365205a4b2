#pragma once

#include <cstddef>

#include "cellcrush/state.h"

namespace cellcrush {

/// Writes the places from `first` to `end`, whole batches, of the candidates that are awake; returns how many there
/// are. REQUIRES: room for all of them and kCandidateBatch more, which are overwritten.
std::size_t find_awake_candidates(const ContactLists& lists, std::size_t first, std::size_t end, int* places);

}  // namespace cellcrush

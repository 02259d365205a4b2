#pragma once

#include <cstddef>
#include <cstdint>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Writes the places of the candidates that overlap in the batches from `first` to `end` to `found`, ascending, and returns
/// how many there are, with the processor's vector instructions; see find_overlaps. REQUIRES: `found` has room for all places
/// of the batches and kSparePlaces more.
std::size_t find_overlapping_wide(const Scene& scene, State& state, std::size_t first, std::size_t end,
                                  std::int64_t* found);

/// Room that vectors may write over.
inline constexpr std::size_t kSparePlaces = 8;

}  // namespace cellcrush

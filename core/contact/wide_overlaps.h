#pragma once

#include <cstdint>
#include <span>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Writes the places of the candidates whose capsules overlap to `found`, ascending, and returns how many there are, with the
/// processor's vector instructions. Takes the places from `first` to `end`. REQUIRES: `found` has room for them and
/// kSparePlaces more.
std::size_t find_overlapping_wide(const Scene& scene, const State& state, std::size_t first, std::size_t end,
                                  std::span<std::int64_t> found);

/// Room that vectors may write over.
inline constexpr std::size_t kSparePlaces = 8;

}  // namespace cellcrush

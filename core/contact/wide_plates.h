#pragma once

#include <cstddef>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Where the plates' faces stand along the crush, mm.
struct PlateFaces {
  double impact;
  double support;
};

/// Writes those of the particles from `first` to `end` whose balls reach into a plate, or that have some friction with it, to
/// `near`, ascending, and returns how many there are; with the processor's vector instructions. REQUIRES: room for all.
std::size_t find_near_plates_wide(const Scene& scene, const State& state, const PlateFaces& faces, std::size_t first,
                                  std::size_t end, int* near);

}  // namespace cellcrush

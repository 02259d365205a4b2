#pragma once

#include <cstddef>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Writes the particles whose balls reach into a plate, or that have some friction with it, to `near`, ascending, and returns
/// how many there are; with the processor's vector instructions. REQUIRES: room for all particles.
std::size_t find_near_plates_wide(const Scene& scene, const State& state, double impact_face, double support_face,
                                  int* near);

}  // namespace cellcrush

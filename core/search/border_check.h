#pragma once

#include <cstdint>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Of the outer face, a band's balls are held against the segments of its own part of the border and its neighbours'
/// (FacesOfBand::is_outer_whole). Whether the parts of bands that are no neighbours are so far apart that none can
/// touch within some steps, unless speeds at the border more than double. REQUIRES: a lattice that is cut into bands.
/// What is not finite is left out: the run is stopped by its check of the state.
bool borders_are_apart(const Scene& scene, const State& state, std::int64_t steps);

}  // namespace cellcrush

#pragma once

#include <cstdint>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// At the outer face, balls of a band are tested against the segments of its own part of the border and of its
/// neighbours only (FacesOfBand::is_outer_whole). Returns whether the parts of bands that are not adjacent are far
/// enough apart: none can touch within `steps` steps unless speeds at the border more than double. REQUIRES: a lattice
/// that is cut into bands. Non-finite positions are ignored; the check of the state stops such a run.
bool borders_are_apart(const Scene& scene, const State& state, std::int64_t steps);

}  // namespace cellcrush

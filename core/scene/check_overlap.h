#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// Problems of walls that overlap before loading: contact would throw them apart in the first step. Names the beams of
/// a frame, or the thickness of a lattice, and the position. REQUIRES: the mesh of the spec, as for the search.
Problems check_overlap(const SceneSpec& spec, const Scene& scene);

}  // namespace cellcrush

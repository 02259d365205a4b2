#pragma once

#include <vector>

#include "cellcrush/contact_faces.h"
#include "cellcrush/scene.h"

namespace cellcrush {

/// The particles on the outer border of a lattice, band by band. REQUIRES: the faces of the bands.
std::vector<BorderParticle> find_border(const Scene& scene);

}  // namespace cellcrush

#pragma once

#include <vector>

#include "cellcrush/contact_faces.h"
#include "cellcrush/scene.h"

namespace cellcrush {

/// The border of a lattice whose bands have their faces.
std::vector<BorderParticle> find_border(const Scene& scene);

}  // namespace cellcrush

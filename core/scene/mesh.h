#pragma once

#include "cellcrush/scene.h"
#include "lattice/layout.h"

namespace cellcrush {

/// Divides the walls into elements: fills the positions, elements and walls of the scene. Joints come first, then the
/// particles inside the walls, block by block. Consecutive walls with the same number of elements share a block. Each
/// rigid wall is one element, after all others. REQUIRES: rigid walls are the last ones.
void divide_walls(const Layout& layout, Scene& scene);

/// Fills incidence_offset, incidence, wall_end_offset and wall_ends.
void link_elements(Scene& scene);

}  // namespace cellcrush

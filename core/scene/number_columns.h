#pragma once

#include <vector>

#include "cellcrush/vector.h"
#include "scene/mesh.h"

namespace cellcrush {

/// Numbers the joints of a large lattice column by column, and its walls in the order of their joints. Bands
/// (scene/bands.h) then run across the lattice and are small. This applies if it is longer along x than along y and its
/// rows run along x. Other lattices, and those with rigid walls, stay as they are. `places` are the positions of the
/// joints before any imperfection, mm.
void number_columns(const std::vector<Vector2>& places, Layout& layout);

}  // namespace cellcrush

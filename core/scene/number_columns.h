#pragma once

#include <vector>

#include "cellcrush/vector.h"
#include "scene/mesh.h"

namespace cellcrush {

/// Numbers the joints of a large lattice that is longer along x than along y, whose rows run along x, column by column,
/// and its walls as their joints follow: bands (scene/bands.h) then run across it and are small. Others, and those with
/// rigid walls, stay as they are. `places` are the joints' before any imperfection, mm.
void number_columns(const std::vector<Vector2>& places, Layout& layout);

}  // namespace cellcrush

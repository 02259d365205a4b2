#pragma once

#include "cellcrush/scene_spec.h"
#include "cellcrush/vector.h"
#include "scene/mesh.h"

namespace cellcrush {

/// Joints and walls of a block of regular hexagons, lower left corner of the envelope at the origin. Rows from the bottom
/// up alternate `columns` and `columns - 1` cells. Every joint and wall is made once.
/// REQUIRES: a checked lattice (all fields set, columns >= 2, rows >= 1).
Layout lay_out_hexagons(const HexagonLattice& lattice, int elements_per_wall);

/// Envelope of the block in mm: sqrt(3) side columns wide in x, (1.5 rows + 0.5) side high in y.
Vector2 envelope_of(const HexagonLattice& lattice);

}  // namespace cellcrush

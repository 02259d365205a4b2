#pragma once

#include "cellcrush/scene_spec.h"
#include "cellcrush/vector.h"
#include "scene/mesh.h"

namespace cellcrush {

// Joints and walls of the regular lattices, lower left corner of the envelope at the origin. Every joint and wall is made
// once. REQUIRES everywhere: a checked lattice, all its fields set.

/// Regular hexagons with walls along y. Rows from the bottom up alternate `columns` and `columns - 1` cells. Walls of cells in
/// stiff rows are thicker by the inclusions' factor.
Layout lay_out(const HexagonLattice& lattice, const Inclusions& inclusions, int elements_per_wall);

/// Squares with walls along x and y.
Layout lay_out(const SquareLattice& lattice, int elements_per_wall);

/// Equilateral triangles with walls along x: `rows` rows between lines of joints that alternate `columns + 1` and `columns`
/// joints, the shorter ones half a side in.
Layout lay_out(const TriangleLattice& lattice, int elements_per_wall);

/// Envelopes in x and y, mm: sqrt(3) side columns by (1.5 rows + 0.5) side; side columns by side rows; side columns by
/// sqrt(3)/2 side rows.
Vector2 envelope_of(const HexagonLattice& lattice);
Vector2 envelope_of(const SquareLattice& lattice);
Vector2 envelope_of(const TriangleLattice& lattice);

}  // namespace cellcrush

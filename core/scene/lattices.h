#pragma once

#include <string>

#include "cellcrush/scene_spec.h"
#include "cellcrush/vector.h"
#include "scene/layout.h"

namespace cellcrush {

/// The regular lattice of a spec; null if it has a frame, or no lattice.
const RegularLattice* regular_lattice_of(const SceneSpec& spec);

/// Squares and triangles: walls lie along the crush and are stacked, in either direction.
bool has_walls_along_crush(const SceneSpec& spec);

/// Path of the fields of the regular lattice of a spec, such as "lattice.hexagon.".
std::string path_of_lattice(const SceneSpec& spec);

/// Walls per cell of a large lattice; the walls along its edges are additional.
double walls_per_cell_of(const SceneSpec& spec);

// REQUIRES in the following: a checked spec of a regular lattice.

/// Joints and walls, with the lower left corner of the envelope at the origin. Every joint and wall is created once,
/// joints in the order of their first use.
///  - Hexagons: walls along y; rows from the bottom up have `columns` and `columns - 1` cells in turn.
///  - Triangles: walls along x; `rows` rows between lines that have `columns + 1` and, shifted by half a side,
///    `columns` joints in turn.
Layout lay_out_cells(const SceneSpec& spec);

/// Envelope in x and y, mm. Hexagons: sqrt(3) side columns by (1.5 rows + 0.5) side. Squares: side columns by side
/// rows. Triangles: side columns by sqrt(3)/2 side rows.
Vector2 envelope_of(const SceneSpec& spec);

/// Quasi-static plastic collapse stress of rigid, perfectly plastic walls, MPa.
///  - Hexagons bend: (2/3) sigma_y (h/L)^2 in either direction, with the thickness of the slanted walls (Gibson and
///    Ashby, Cellular Solids, 2nd ed., section 4.3).
///  - Squares yield axially: sigma_y h/L.
///  - Triangles yield axially: (2/sqrt 3) sigma_y h/L along their walls, carried by the walls along the load; sqrt 3
///    sigma_y h/L across them, carried by the others.
double collapse_stress_of(const SceneSpec& spec);

}  // namespace cellcrush

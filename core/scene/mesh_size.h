#pragma once

#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// Most elements of a mesh: what a machine of 2 GB holds with room to spare.
inline constexpr double kMostElements = 2e6;

/// Walls per cell of a large lattice; the walls along its edges are additional.
inline constexpr double kWallsOfHexagon = 3.0;
inline constexpr double kWallsOfSquare = 2.0;
inline constexpr double kWallsOfTriangle = 3.0;

/// Number of elements of the walls of so many cells.
inline double count_elements(double walls_per_cell, int columns, int rows, int elements_per_wall) {
  return walls_per_cell * columns * rows * elements_per_wall;
}

/// Number of elements of the beams of a frame.
double count_elements(const FrameLattice& frame, int elements_per_wall);

/// Approximate number of elements of the mesh of a spec, without building it. For a frame it is exact. For a regular
/// lattice it omits the walls along the edges, and rigid walls have fewer. REQUIRES: a lattice without problems that
/// prevent meshing.
double count_elements(const SceneSpec& spec);

}  // namespace cellcrush

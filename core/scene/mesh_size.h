#pragma once

#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// Most elements of a mesh that is built: what a machine of 2 GB holds with room to spare.
inline constexpr double kMostElements = 2e6;

/// Walls that a cell adds to a large lattice; those along its edges come on top.
inline constexpr double kWallsOfHexagon = 3.0;
inline constexpr double kWallsOfSquare = 2.0;
inline constexpr double kWallsOfTriangle = 3.0;

/// Elements of the walls of so many cells.
inline double count_elements(double walls_per_cell, int columns, int rows, int elements_per_wall) {
  return walls_per_cell * columns * rows * elements_per_wall;
}

/// Elements of a frame's beams.
double count_elements(const FrameLattice& frame, int elements_per_wall);

/// About how many elements the mesh of a spec has, without building it: of a frame exactly so many; of a regular
/// lattice those along its edges come on top, and rigid walls are fewer. REQUIRES: a lattice in which nothing spoils
/// the mesh.
double count_elements(const SceneSpec& spec);

}  // namespace cellcrush

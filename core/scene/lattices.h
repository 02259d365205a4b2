#pragma once

#include <optional>
#include <vector>

#include "cellcrush/scene_spec.h"
#include "cellcrush/vector.h"
#include "scene/lattice_pattern.h"
#include "scene/mesh.h"

namespace cellcrush {

// The regular lattices, with the lower left corner of the envelope at the origin. Every joint and wall is created once.
// REQUIRES everywhere: a checked lattice with all its fields set.

/// The parameters that determine the pattern of a regular lattice.
struct LatticeShape {
  enum class Cell {
    hexagon,  ///< walls along y; rows from the bottom up have `columns` and `columns - 1` cells in turn
    square,   ///< walls along x and y
    /// Walls along x; `rows` rows between lines that have `columns + 1` and, shifted by half a side, `columns` joints
    /// in turn.
    triangle
  };
  Cell cell = Cell::hexagon;
  int columns = 0;
  int rows = 0;
  std::vector<int> stiff_rows;  ///< of hexagons, from 1 at the bottom
};

/// The sizes that turn a pattern into a layout.
struct LatticeSizes {
  double side = 0.0;          ///< L, mm
  ByWallKind thickness = {};  ///< mm; stiff walls are at least as thick as the others
  bool rigid = false;         ///< whether stiff walls are parts of rigid bodies
  int elements_per_wall = 1;
};

struct RegularLattice {
  LatticeShape shape;
  LatticeSizes sizes;
};

RegularLattice regular_lattice(const HexagonLattice& lattice, const Inclusions& inclusions, int elements_per_wall);
RegularLattice regular_lattice(const SquareLattice& lattice, int elements_per_wall);
RegularLattice regular_lattice(const TriangleLattice& lattice, int elements_per_wall);
/// The regular lattice of a spec; none for a frame.
std::optional<RegularLattice> regular_lattice_of(const SceneSpec& spec);

Layout lay_out(const RegularLattice& lattice);

/// Envelope in x and y, mm. Hexagons: sqrt(3) side columns by (1.5 rows + 0.5) side. Squares: side columns by side
/// rows. Triangles: side columns by sqrt(3)/2 side rows.
Vector2 envelope_of(const RegularLattice& lattice);

}  // namespace cellcrush

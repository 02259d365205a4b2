#pragma once

#include <optional>
#include <vector>

#include "cellcrush/scene_spec.h"
#include "cellcrush/vector.h"
#include "scene/lattice_pattern.h"
#include "scene/mesh.h"

namespace cellcrush {

// The regular lattices, lower left corner of the envelope at the origin. Every joint and wall is made once.
// REQUIRES everywhere: a checked lattice, all its fields set.

/// What the pattern of a regular lattice depends on.
struct LatticeShape {
  enum class Cell {
    hexagon,  ///< walls along y; rows from the bottom up alternate `columns` and `columns - 1` cells
    square,   ///< walls along x and y
    triangle  ///< walls along x; `rows` rows between lines that alternate `columns + 1` and `columns` joints, half a
              ///< side in
  };
  Cell cell = Cell::hexagon;
  int columns = 0;
  int rows = 0;
  std::vector<int> stiff_rows;  ///< of hexagons, from 1 at the bottom
};

/// What makes a layout of a pattern.
struct LatticeSizes {
  double side = 0.0;          ///< L, mm
  ByWallKind thickness = {};  ///< mm; stiff walls are at least as thick as those that are not
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
/// The regular lattice of a spec; none of a frame.
std::optional<RegularLattice> regular_lattice_of(const SceneSpec& spec);

Layout lay_out(const RegularLattice& lattice);

/// Envelopes in x and y, mm: sqrt(3) side columns by (1.5 rows + 0.5) side; side columns by side rows; side columns by
/// sqrt(3)/2 side rows.
Vector2 envelope_of(const RegularLattice& lattice);

}  // namespace cellcrush

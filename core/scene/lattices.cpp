#include "scene/lattices.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <variant>

#include "scene/pattern_builder.h"

namespace cellcrush {
namespace {

using Cell = LatticeShape::Cell;
using GridPoint = LatticePattern::GridPoint;
constexpr double kHalfRoot3 = 0.5 * std::numbers::sqrt3;

LatticePattern pattern_of_hexagons(const LatticeShape& shape) {
  PatternBuilder builder({2 * shape.columns, 3 * shape.rows + 1});
  for (int row = 0; row < shape.rows; ++row) {
    const bool stiff = std::find(shape.stiff_rows.begin(), shape.stiff_rows.end(), row + 1) != shape.stiff_rows.end();
    const int shift = row % 2;  // odd rows are one cell shorter and are shifted by half a pitch
    for (int column = 0; column < shape.columns - shift; ++column) {
      const int x = 2 * column + shift;
      const int y = 3 * row;
      // Corners counter-clockwise from the lowest; walls 1-2 and 4-5 run along y.
      const std::array<GridPoint, 6> corner = {
          {{x + 1, y}, {x + 2, y + 1}, {x + 2, y + 3}, {x + 1, y + 4}, {x, y + 3}, {x, y + 1}}};
      for (int i = 0; i < 6; ++i) {
        const bool upright = i == 1 || i == 4;
        builder.add_wall(corner[i], corner[(i + 1) % 6], (upright ? kUprightWall : 0) + (stiff ? kStiffWall : 0));
      }
    }
  }
  return builder.take();
}

LatticePattern pattern_of_squares(const LatticeShape& shape) {
  PatternBuilder builder({shape.columns, shape.rows});
  for (int y = 0; y <= shape.rows; ++y) {
    for (int x = 0; x <= shape.columns; ++x) {
      if (x < shape.columns) {
        builder.add_wall({x, y}, {x + 1, y}, 0);
      }
      if (y < shape.rows) {
        builder.add_wall({x, y}, {x, y + 1}, 0);
      }
    }
  }
  return builder.take();
}

LatticePattern pattern_of_triangles(const LatticeShape& shape) {
  PatternBuilder builder({2 * shape.columns, shape.rows});
  for (int y = 0; y <= shape.rows; ++y) {
    const int shift = y % 2;
    const int last = 2 * shape.columns - shift;
    for (int x = shift; x <= last; x += 2) {
      if (x < last) {
        builder.add_wall({x, y}, {x + 2, y}, 0);
      }
      for (const int upper : {x - 1, x + 1}) {
        const bool inside = upper >= 1 - shift && upper <= 2 * shape.columns - (1 - shift);
        if (y < shape.rows && inside) {
          builder.add_wall({x, y}, {upper, y + 1}, 0);
        }
      }
    }
  }
  return builder.take();
}

/// Grid spacing of the pattern, mm. Hexagons: half pitches in x, half sides in y. Triangles: half sides in x, rows in
/// y.
Vector2 unit_of(Cell cell, double side) {
  switch (cell) {
    case Cell::hexagon: return {kHalfRoot3 * side, 0.5 * side};
    case Cell::square: return {side, side};
    case Cell::triangle: break;
  }
  return {0.5 * side, kHalfRoot3 * side};
}

LatticePattern pattern_of(const LatticeShape& shape) {
  switch (shape.cell) {
    case Cell::hexagon: return pattern_of_hexagons(shape);
    case Cell::square: return pattern_of_squares(shape);
    case Cell::triangle: break;
  }
  return pattern_of_triangles(shape);
}

/// Positions of the joints of a pattern, mm.
std::vector<Vector2> place_joints(const LatticePattern& pattern, LatticeShape::Cell cell, double side) {
  const Vector2 unit = unit_of(cell, side);
  std::vector<Vector2> joints;
  joints.reserve(pattern.joints.size());
  for (const auto& [x, y] : pattern.joints) {
    joints.emplace_back(unit.x() * x, unit.y() * y);
  }
  return joints;
}

}  // namespace

RegularLattice regular_lattice(const HexagonLattice& lattice, const Inclusions& inclusions, int elements_per_wall) {
  const double slanted = *lattice.wall_thickness_mm;
  const double upright = lattice.vertical_wall_thickness_mm.value_or(slanted);
  const double factor = inclusions.thickness_factor;
  return {{Cell::hexagon, *lattice.columns, *lattice.rows, inclusions.rows},
          {*lattice.side_mm,
           {slanted, upright, factor * slanted, factor * upright},
           inclusions.model == Inclusions::Model::rigid,
           elements_per_wall}};
}

RegularLattice regular_lattice(const SquareLattice& lattice, int elements_per_wall) {
  return {{Cell::square, *lattice.columns, *lattice.rows, {}},
          {*lattice.side_mm, {*lattice.wall_thickness_mm}, false, elements_per_wall}};
}

RegularLattice regular_lattice(const TriangleLattice& lattice, int elements_per_wall) {
  return {{Cell::triangle, *lattice.columns, *lattice.rows, {}},
          {*lattice.side_mm, {*lattice.wall_thickness_mm}, false, elements_per_wall}};
}

std::optional<RegularLattice> regular_lattice_of(const SceneSpec& spec) {
  const int elements = *spec.elements_per_wall;
  if (const auto* hexagon = std::get_if<HexagonLattice>(&spec.lattice)) {
    return regular_lattice(*hexagon, spec.inclusions, elements);
  }
  if (const auto* square = std::get_if<SquareLattice>(&spec.lattice)) {
    return regular_lattice(*square, elements);
  }
  if (const auto* triangle = std::get_if<TriangleLattice>(&spec.lattice)) {
    return regular_lattice(*triangle, elements);
  }
  return std::nullopt;
}

Layout lay_out(const RegularLattice& lattice) {
  const LatticePattern pattern = pattern_of(lattice.shape);
  Layout layout = {place_joints(pattern, lattice.shape.cell, lattice.sizes.side), {}};
  layout.walls.reserve(pattern.walls.size());
  for (const LatticePattern::Wall& wall : pattern.walls) {
    const bool rigid = lattice.sizes.rigid && (wall.kind & kStiffWall) != 0;
    layout.walls.push_back(
        {wall.start, wall.end, lattice.sizes.thickness[wall.kind], lattice.sizes.elements_per_wall, 0, rigid});
  }
  return layout;
}

Vector2 envelope_of(const RegularLattice& lattice) {
  const double side = lattice.sizes.side;
  const auto& [cell, columns, rows, stiff_rows] = lattice.shape;
  switch (cell) {
    case Cell::hexagon: return {std::numbers::sqrt3 * side * columns, (1.5 * rows + 0.5) * side};
    case Cell::square: return {side * columns, side * rows};
    case Cell::triangle: break;
  }
  return {side * columns, kHalfRoot3 * side * rows};
}

}  // namespace cellcrush

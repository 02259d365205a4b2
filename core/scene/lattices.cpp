#include "scene/lattices.h"

#include <algorithm>
#include <array>
#include <numbers>

#include "scene/layout_builder.h"

namespace cellcrush {
namespace {

using GridPoint = LayoutBuilder::GridPoint;
constexpr double kHalfRoot3 = 0.5 * std::numbers::sqrt3;

}  // namespace

Layout lay_out(const HexagonLattice& lattice, const Inclusions& inclusions, int elements_per_wall) {
  const double slanted = *lattice.wall_thickness_mm;
  const double vertical = lattice.vertical_wall_thickness_mm.value_or(slanted);
  // Half pitches in x, half sides in y.
  LayoutBuilder builder({kHalfRoot3 * *lattice.side_mm, 0.5 * *lattice.side_mm}, elements_per_wall);
  for (int row = 0; row < *lattice.rows; ++row) {
    const bool stiff = std::find(inclusions.rows.begin(), inclusions.rows.end(), row + 1) != inclusions.rows.end();
    const double factor = stiff ? inclusions.thickness_factor : 1.0;
    const bool rigid = stiff && inclusions.model == Inclusions::Model::rigid;
    const int shift = row % 2;  // odd rows are one cell shorter and start half a pitch in
    for (int column = 0; column < *lattice.columns - shift; ++column) {
      const int x = 2 * column + shift;
      const int y = 3 * row;
      // Corners counter-clockwise from the lowest; walls 1-2 and 4-5 stand along y.
      const std::array<GridPoint, 6> corner = {
          {{x + 1, y}, {x + 2, y + 1}, {x + 2, y + 3}, {x + 1, y + 4}, {x, y + 3}, {x, y + 1}}};
      for (int i = 0; i < 6; ++i) {
        builder.add_wall(corner[i], corner[(i + 1) % 6], factor * (i == 1 || i == 4 ? vertical : slanted), rigid);
      }
    }
  }
  return builder.take();
}

Layout lay_out(const SquareLattice& lattice, int elements_per_wall) {
  LayoutBuilder builder({*lattice.side_mm, *lattice.side_mm}, elements_per_wall);
  const double thickness = *lattice.wall_thickness_mm;
  for (int y = 0; y <= *lattice.rows; ++y) {
    for (int x = 0; x <= *lattice.columns; ++x) {
      if (x < *lattice.columns) {
        builder.add_wall({x, y}, {x + 1, y}, thickness);
      }
      if (y < *lattice.rows) {
        builder.add_wall({x, y}, {x, y + 1}, thickness);
      }
    }
  }
  return builder.take();
}

Layout lay_out(const TriangleLattice& lattice, int elements_per_wall) {
  // Half sides in x, rows in y.
  LayoutBuilder builder({0.5 * *lattice.side_mm, kHalfRoot3 * *lattice.side_mm}, elements_per_wall);
  const double thickness = *lattice.wall_thickness_mm;
  for (int y = 0; y <= *lattice.rows; ++y) {
    const int shift = y % 2;
    const int last = 2 * *lattice.columns - shift;
    for (int x = shift; x <= last; x += 2) {
      if (x < last) {
        builder.add_wall({x, y}, {x + 2, y}, thickness);
      }
      for (const int upper : {x - 1, x + 1}) {
        const bool inside = upper >= 1 - shift && upper <= 2 * *lattice.columns - (1 - shift);
        if (y < *lattice.rows && inside) {
          builder.add_wall({x, y}, {upper, y + 1}, thickness);
        }
      }
    }
  }
  return builder.take();
}

Vector2 envelope_of(const HexagonLattice& lattice) {
  return {std::numbers::sqrt3 * *lattice.side_mm * *lattice.columns, (1.5 * *lattice.rows + 0.5) * *lattice.side_mm};
}

Vector2 envelope_of(const SquareLattice& lattice) {
  return {*lattice.side_mm * *lattice.columns, *lattice.side_mm * *lattice.rows};
}

Vector2 envelope_of(const TriangleLattice& lattice) {
  return {*lattice.side_mm * *lattice.columns, kHalfRoot3 * *lattice.side_mm * *lattice.rows};
}

}  // namespace cellcrush

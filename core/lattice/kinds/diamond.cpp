#include <numbers>

#include "lattice/lattice.h"
#include "lattice/layout.h"

// Squares that stand on a corner: `rows` rows of `columns` cells side by side, with further cells between them.
//
// Closed forms, with r = t/l. Under a stress along x or y a wall bears a load sigma l / sqrt 2 at 45 degrees, whose
// parts bend it and press it (kinds/hexagon.cpp): E* = 2 E r^3 / (1 + r^2) and nu* = (1 - r^2) / (1 + r^2), exact for
// beams without shear. Hinges at the ends of all walls give a collapse stress of sigma_y r^2, that of hexagons with
// h = 0 at a cell angle of 45 degrees.
namespace cellcrush {
namespace {

Layout lay_out_diamonds(const SceneSpec& spec) {
  const RegularLattice& diamonds = *regular_lattice_of(spec);
  const double half_diagonal = 0.5 * std::numbers::sqrt2 * *diamonds.side_mm;
  const JointGrid grid = even_grid({2 * *diamonds.columns, 2 * *diamonds.rows}, {half_diagonal, half_diagonal});
  WallBuilder builder(grid);
  for (int row = 0; row < *diamonds.rows; ++row) {
    for (int column = 0; column < *diamonds.columns; ++column) {
      const GridPoint low(2 * column + 1, 2 * row);
      const GridPoint right(2 * column + 2, 2 * row + 1);
      const GridPoint high(2 * column + 1, 2 * row + 2);
      const GridPoint left(2 * column, 2 * row + 1);
      builder.add_wall(low, right, *diamonds.wall_thickness_mm);
      builder.add_wall(right, high, *diamonds.wall_thickness_mm);
      builder.add_wall(high, left, *diamonds.wall_thickness_mm);
      builder.add_wall(left, low, *diamonds.wall_thickness_mm);
    }
  }
  return builder.take();
}

Vector2 period_of_diamonds(const RegularLattice& diamonds) {
  return std::numbers::sqrt2 * *diamonds.side_mm * Vector2(*diamonds.columns, *diamonds.rows);
}

ClosedForms forms_of_diamonds(const RegularLattice& diamonds, LoadingSpec::Direction) {
  const double ratio = *diamonds.wall_thickness_mm / *diamonds.side_mm;
  const double squared = ratio * ratio;
  return {.density = 2.0 * ratio,
          .modulus = 2.0 * ratio * squared / (1.0 + squared),
          .poissons_ratio = (1.0 - squared) / (1.0 + squared),
          .collapse_stress = squared};
}

}  // namespace

const LatticeKind& diamond_lattice() {
  static const LatticeKind kKind = {
      .name = "diamond",
      .plural = "diamonds",
      .walls_per_cell = 4.0,
      .lay_out = lay_out_diamonds,
      .period = period_of_diamonds,
      .closed_forms = forms_of_diamonds,
      .theory_note = [](const RegularLattice&) { return note_of_turning_walls("0.8"); },
  };
  return kKind;
}

}  // namespace cellcrush

#include <numbers>

#include "lattice/lattice.h"
#include "lattice/layout.h"
#include "lattice/period.h"

// Hexagons and triangles in turn (trihexagonal), with walls along x. Between two lines of walls along x stand pairs of
// triangles, apex on apex: `columns` and, shifted by a side, `columns - 1` of them in turn, from the bottom up.
namespace cellcrush {
namespace {

Layout lay_out_kagome(const SceneSpec& spec) {
  const RegularLattice& kagome = *regular_lattice_of(spec);
  const double side = *kagome.side_mm;
  const int rows = *kagome.rows;
  const bool repeats = repeats_along(spec, 0);
  const int walls = 2 * *kagome.columns - (repeats ? 0 : 1);  // of a line
  const JointGrid half_sides = even_grid({2 * walls, 2 * rows}, {0.5 * side, 0.5 * std::numbers::sqrt3 * side});
  WallBuilder builder(half_sides);
  const double thickness = *kagome.wall_thickness_mm;
  for (int line = 0; line <= rows; ++line) {
    const int y = 2 * line;
    const int short_end = line == rows && rows % 2 == 0 && !repeats ? 1 : 0;  // no wall ends freely
    for (int x = short_end; x < walls - short_end; ++x) {
      builder.add_wall({2 * x, y}, {2 * x + 2, y}, thickness);
    }
    for (int x = line % 2; line < rows && x < walls; x += 2) {
      const GridPoint apex(2 * x + 1, y + 1);
      for (const int end : {2 * x, 2 * x + 2}) {
        builder.add_wall({end, y}, apex, thickness);
        builder.add_wall(apex, {end, y + 2}, thickness);
      }
    }
  }
  return builder.take();
}

Vector2 period_of_kagome(const RegularLattice& kagome) {
  const int even_rows = *kagome.rows % 2 == 0 ? *kagome.rows : 0;
  return *kagome.side_mm * Vector2(2.0 * *kagome.columns, std::numbers::sqrt3 * even_rows);
}

/// Walls yield axially: sigma_y t / (sqrt 3 l) along the lines of walls along x; sqrt 3 / 2 sigma_y t / l across them,
/// carried by the other two families. The moduli are those of walls that stretch and bend. Every joint is a centre of
/// inversion, so that joints move evenly, and turn against the mean of their walls; exact for beams without shear.
ClosedForms forms_of_kagome(const RegularLattice& kagome, LoadingSpec::Direction direction) {
  const double ratio = *kagome.wall_thickness_mm / *kagome.side_mm;
  const double bending = 0.5 * ratio * ratio;  // of the shear modulus
  const bool is_along_walls = direction == LoadingSpec::Direction::x;
  return {.density = std::numbers::sqrt3 * ratio,
          .modulus = ratio / std::numbers::sqrt3 * (1.0 + bending) / (1.0 + bending / 3.0),
          .poissons_ratio = (1.0 - bending) / (3.0 + bending),
          .collapse_stress = (is_along_walls ? 1.0 / std::numbers::sqrt3 : 0.5 * std::numbers::sqrt3) * ratio};
}

}  // namespace

const LatticeKind& kagome_lattice() {
  static const LatticeKind kKind = {
      .name = "kagome",
      .plural = "kagome",
      .walls_per_cell = 6.0,
      .has_walls_along_crush = true,
      .step_cost = 1.1,
      .lay_out = lay_out_kagome,
      .period = period_of_kagome,
      .closed_forms = forms_of_kagome,
      .theory_note = [](const RegularLattice&) { return note_of_stretched_walls("Kagome lattices"); },
  };
  return kKind;
}

}  // namespace cellcrush

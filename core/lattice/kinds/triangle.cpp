#include <numbers>

#include "lattice/lattice.h"
#include "lattice/layout.h"
#include "lattice/period.h"

// Equilateral triangles with walls along x: `rows` rows between lines that have `columns + 1` and, shifted by half a
// side, `columns` joints in turn.
namespace cellcrush {
namespace {

Layout lay_out_triangles(const SceneSpec& spec) {
  const RegularLattice& triangles = *regular_lattice_of(spec);
  const double side = *triangles.side_mm;
  const JointGrid half_sides_and_rows =
      even_grid({2 * *triangles.columns + 1, *triangles.rows}, {0.5 * side, 0.5 * std::numbers::sqrt3 * side});
  WallBuilder builder(half_sides_and_rows);
  const double thickness = *triangles.wall_thickness_mm;
  const bool repeats = repeats_along(spec, 0);
  for (int y = 0; y <= *triangles.rows; ++y) {
    const int shift = y % 2;
    const int last = 2 * *triangles.columns - shift;
    for (int x = shift; x <= last; x += 2) {
      if (x < last || (shift == 1 && repeats)) {
        builder.add_wall({x, y}, {x + 2, y}, thickness);
      }
      for (const int upper : {x - 1, x + 1}) {
        const bool inside = upper >= 1 - shift && upper <= 2 * *triangles.columns - (1 - shift);
        if (y < *triangles.rows && inside) {
          builder.add_wall({x, y}, {upper, y + 1}, thickness);
        }
      }
    }
  }
  return builder.take();
}

/// Walls yield axially: (2/sqrt 3) sigma_y h/L along their walls, carried by the walls along the load; sqrt 3 sigma_y
/// h/L across them, carried by the others. The moduli are those of walls that stretch and, clamped at the joints, bend.
Vector2 period_of_triangles(const RegularLattice& triangles) {
  const int even_rows = *triangles.rows % 2 == 0 ? *triangles.rows : 0;
  return *triangles.side_mm * Vector2(*triangles.columns, 0.5 * std::numbers::sqrt3 * even_rows);
}

ClosedForms forms_of_triangles(const RegularLattice& triangles, LoadingSpec::Direction direction) {
  const double ratio = *triangles.wall_thickness_mm / *triangles.side_mm;
  const double squared = ratio * ratio;
  const bool is_along_walls = direction == LoadingSpec::Direction::x;
  return {.density = 2.0 * std::numbers::sqrt3 * ratio,
          .modulus = 2.0 / std::numbers::sqrt3 * ratio * (1.0 + squared) / (1.0 + squared / 3.0),
          .poissons_ratio = (1.0 - squared) / (3.0 + squared),
          .collapse_stress = (is_along_walls ? 2.0 / std::numbers::sqrt3 : std::numbers::sqrt3) * ratio};
}

}  // namespace

const LatticeKind& triangle_lattice() {
  static const LatticeKind kKind = {
      .name = "triangle",
      .plural = "triangles",
      .walls_per_cell = 3.0,
      .has_walls_along_crush = true,
      .step_cost = 1.17,
      .lay_out = lay_out_triangles,
      .period = period_of_triangles,
      .closed_forms = forms_of_triangles,
      .theory_note = [](const RegularLattice&) { return note_of_stretched_walls("Triangles"); },
  };
  return kKind;
}

}  // namespace cellcrush

#include "lattice/lattice.h"
#include "lattice/layout.h"

// Squares with walls along x and y.
namespace cellcrush {
namespace {

Layout lay_out_squares(const SceneSpec& spec) {
  const RegularLattice& squares = *regular_lattice_of(spec);
  const JointGrid grid = even_grid({*squares.columns, *squares.rows}, {*squares.side_mm, *squares.side_mm});
  WallBuilder builder(grid);
  for (int y = 0; y <= *squares.rows; ++y) {
    for (int x = 0; x <= *squares.columns; ++x) {
      if (x < *squares.columns) {
        builder.add_wall({x, y}, {x + 1, y}, *squares.wall_thickness_mm);
      }
      if (y < *squares.rows) {
        builder.add_wall({x, y}, {x, y + 1}, *squares.wall_thickness_mm);
      }
    }
  }
  return builder.take();
}

/// Walls along the load are pressed, and yield axially at sigma_y h/L.
Vector2 period_of_squares(const RegularLattice& squares) {
  return *squares.side_mm * Vector2(*squares.columns, *squares.rows);
}

ClosedForms forms_of_squares(const RegularLattice& squares, LoadingSpec::Direction) {
  const double ratio = *squares.wall_thickness_mm / *squares.side_mm;
  return {.density = 2.0 * ratio, .modulus = ratio, .poissons_ratio = 0.0, .collapse_stress = ratio};
}

}  // namespace

const LatticeKind& square_lattice() {
  static const LatticeKind kKind = {
      .name = "square",
      .plural = "squares",
      .walls_per_cell = 2.0,
      .has_walls_along_crush = true,
      .step_cost = 1.25,
      .lay_out = lay_out_squares,
      .period = period_of_squares,
      .closed_forms = forms_of_squares,
      .theory_note =
          [](const RegularLattice&) {
            return note_of_stretched_walls("Squares") +
                   " Thin squares without hardening (5 % of the side) have no converged mesh: plateaus of 4 and 8 "
                   "elements per wall differ by a quarter.";
          },
  };
  return kKind;
}

}  // namespace cellcrush

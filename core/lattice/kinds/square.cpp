#include "lattice/lattice.h"
#include "lattice/layout.h"

// Squares with walls along x and y.
namespace cellcrush {
namespace {

JointGrid grid_of_squares(const SceneSpec& spec) {
  const RegularLattice& squares = *regular_lattice_of(spec);
  return {{*squares.columns, *squares.rows}, {*squares.side_mm, *squares.side_mm}};
}

Layout lay_out_squares(const SceneSpec& spec) {
  const RegularLattice& squares = *regular_lattice_of(spec);
  WallBuilder builder(grid_of_squares(spec), *spec.elements_per_wall);
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

/// Walls along the load yield axially: sigma_y h/L.
double collapse_stress_of_squares(const SceneSpec& spec) {
  const RegularLattice& squares = *regular_lattice_of(spec);
  return *spec.material.yield_stress_mpa * *squares.wall_thickness_mm / *squares.side_mm;
}

}  // namespace

const LatticeKind& square_lattice() {
  static const LatticeKind kKind = {
      .name = "square",
      .plural = "squares",
      .walls_per_cell = 2.0,
      .has_walls_along_crush = true,
      .envelope = [](const SceneSpec& spec) { return grid_of_squares(spec).envelope(); },
      .lay_out = lay_out_squares,
      .collapse_stress = collapse_stress_of_squares,
      // No mesh keeps the bounds of the hexagons' STANDARD at every speed; this one is that of triangles.
      .mesh = [](const SceneSpec&) { return mesh_of_stacked_walls("squares"); },
      .theory_note = note_of_stretched_walls("Squares") +
                     " Thin squares without hardening (5 % of the side) have no converged mesh: plateaus of 4 and 8 "
                     "elements per wall differ by a quarter.",
  };
  return kKind;
}

}  // namespace cellcrush

#include <algorithm>
#include <cmath>
#include <numbers>

#include "fields/field_checker.h"
#include "lattice/lattice.h"
#include "lattice/layout.h"

// Squares whose sides are full sine waves of amplitude a, two walls a side, each half a wave. A turn by 90 degrees
// brings the lattice upon itself; no line is one of symmetry.
//
// Closed forms. Every joint is a centre of inversion, so it bears no moment: a side under the load sigma l bends under
// sigma l y and is pressed by sigma l cos alpha, with its offset y and slope alpha. Hence 1 / E* = integral of
// (12 y^2 / t^3 + cos^2 alpha / t) ds / E over a side, nu* = 0 (sides across are free of load), and hinges at the
// crests: sigma_y t^2 / (4 a l).
namespace cellcrush {
namespace {

constexpr const char* kAmplitude = "amplitude_mm";

void check_sinusoidal_squares(const SceneSpec& spec, double, FieldChecker& check) {
  if (*spec.elements_per_wall == 1) {
    check.add("elements_per_wall", "1", "makes half a sine wave a straight wall.", "Give at least 2.");
  }
}

Layout lay_out_sinusoidal_squares(const SceneSpec& spec) {
  const RegularLattice& squares = *regular_lattice_of(spec);
  const double half_side = 0.5 * *squares.side_mm;
  const double thickness = *squares.wall_thickness_mm;
  const double amplitude = own_number(squares, kAmplitude);
  const GridPoint last(2 * *squares.columns, 2 * *squares.rows);
  WallBuilder builder(even_grid(last, {half_side, half_side}));
  // The first half of a side lies to its left, upwards or to the right; the other half to its right.
  for (int y = 0; y <= last.y(); ++y) {
    for (int x = 0; x <= last.x(); ++x) {
      if (y % 2 == 0 && x < last.x()) {
        builder.add_wall({x, y}, {x + 1, y}, thickness).bow = x % 2 == 0 ? amplitude : -amplitude;
      }
      if (x % 2 == 0 && y < last.y()) {
        builder.add_wall({x, y}, {x, y + 1}, thickness).bow = y % 2 == 0 ? amplitude : -amplitude;
      }
    }
  }
  return builder.take();
}

Vector2 period_of_sinusoidal_squares(const RegularLattice& squares) {
  return *squares.side_mm * Vector2(*squares.columns, *squares.rows);
}

ClosedForms forms_of_sinusoidal_squares(const RegularLattice& squares, LoadingSpec::Direction) {
  constexpr int kPoints = 64;  // of a periodic integrand, which the mean of its values integrates fast
  const double ratio = *squares.wall_thickness_mm / *squares.side_mm;
  const double amplitude = own_number(squares, kAmplitude) / *squares.side_mm;
  double arc = 0.0;      // over the side
  double bending = 0.0;  // mean of y^2 ds
  double pressing = 0.0;
  for (int i = 0; i < kPoints; ++i) {
    const double phase = 2.0 * std::numbers::pi * i / kPoints;
    const double slope = 2.0 * std::numbers::pi * amplitude * std::cos(phase);
    const double offset = amplitude * std::sin(phase);
    const double stretch = std::sqrt(1.0 + slope * slope);
    arc += stretch / kPoints;
    bending += offset * offset * stretch / kPoints;
    pressing += 1.0 / stretch / kPoints;
  }
  return {.density = 2.0 * ratio * arc,
          .modulus = 1.0 / (12.0 * bending / (ratio * ratio * ratio) + pressing / ratio),
          .poissons_ratio = 0.0,
          .collapse_stress = std::min(ratio, ratio * ratio / (4.0 * amplitude))};
}

}  // namespace

const LatticeKind& sinusoidal_square_lattice() {
  static const LatticeKind kKind = {
      .name = "sinusoidal_square",
      .plural = "sinusoidal squares",
      .walls_per_cell = 4.0,
      .step_cost = 1.27,
      .own_numbers = {{kAmplitude, [](const RegularLattice& its) { return 0.1 * its.side_mm.value_or(0.0); }, 0.25}},
      .check = check_sinusoidal_squares,
      .lay_out = lay_out_sinusoidal_squares,
      .period = period_of_sinusoidal_squares,
      .closed_forms = forms_of_sinusoidal_squares,
      .mesh =
          [](const SceneSpec&) {
            return DefaultMesh{2, 4, 8, "sinusoidal squares"};
          },
      .theory_note = [](const RegularLattice&) { return note_of_turning_walls("0.5"); },
  };
  return kKind;
}

}  // namespace cellcrush

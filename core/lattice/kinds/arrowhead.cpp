#include <cmath>
#include <numbers>

#include "fields/field_checker.h"
#include "geometry/unit_direction.h"
#include "lattice/lattice.h"
#include "lattice/layout.h"

// Arrowheads that point up (double arrowheads): long walls at the angle theta to x lead to the tip, short ones at the
// smaller angle phi to the notch; the notch of a cell is the tip of the one below. Auxetic.
//
// Closed forms, with the long walls of length l, b = l cos theta, the period p = b (tan theta - tan phi) along y, the
// cell of 2 b by p, and two walls of each kind in it. All joints lie on lines of symmetry, so no joint turns: a wall of
// length L resists an axial relative displacement of its ends with E t / L and one across with E t^3 / L^3. Strains
// e1 along x and e2 along y move the ends of a short wall by (b e1, v) and of a long one by (b e1, v + p e2), with the
// v of least energy. Exact for beams without shear. Collapse: hinges at the ends of all walls, which turn by d phi =
// (tan theta / tan phi) d theta.
namespace cellcrush {
namespace {

constexpr const char* kLongAngle = "long_angle_degrees";
constexpr const char* kShortAngle = "short_angle_degrees";

double tangent_of(double degrees) {
  const Vector2 direction = unit_direction(degrees);
  return direction.y() / direction.x();
}

double half_width_of(const RegularLattice& arrowheads) {
  return *arrowheads.side_mm * unit_direction(own_number(arrowheads, kLongAngle)).x();
}

void check_arrowheads(const SceneSpec& spec, double, FieldChecker& check) {
  const RegularLattice& arrowheads = *regular_lattice_of(spec);
  const double of_long = own_number(arrowheads, kLongAngle);
  const double of_short = own_number(arrowheads, kShortAngle);
  constexpr double kLeastDifference = 1.0;  // degrees
  if (of_long - of_short < kLeastDifference) {
    check.add("lattice.arrowhead.short_angle_degrees", to_text(of_short),
              "leaves nothing between the short and the long walls, at " + to_text(of_long) + " degrees.",
              "Give at most long_angle_degrees - 1.");
  }
}

std::vector<Vector2> walls_of_arrowhead(const RegularLattice& arrowheads) {
  const Vector2 to_tip = arrowheads.side_mm.value_or(0.0) * unit_direction(own_number(arrowheads, kLongAngle));
  const double notch = to_tip.x() * tangent_of(own_number(arrowheads, kShortAngle));
  return {to_tip, {to_tip.x(), -to_tip.y()}, {to_tip.x(), notch}, {to_tip.x(), -notch}};
}

Layout lay_out_arrowheads(const SceneSpec& spec) {
  const RegularLattice& arrowheads = *regular_lattice_of(spec);
  const double half_width = half_width_of(arrowheads);
  const double notch = half_width * tangent_of(own_number(arrowheads, kShortAngle));
  const double period = half_width * tangent_of(own_number(arrowheads, kLongAngle)) - notch;
  // Columns of tips and, between them, of feet: from one tip, or notch, to the next it is a period.
  const int columns = *arrowheads.columns;
  const int rows = *arrowheads.rows;
  const JointGrid grid = {{2 * columns, rows}, [=](const GridPoint& point) -> Vector2 {
                            return {half_width * point.x(), period * point.y() + (point.x() % 2 == 0 ? 0.0 : notch)};
                          }};
  WallBuilder builder(grid);
  for (int y = 0; y < rows; ++y) {
    for (int tip = 1; tip < 2 * columns; tip += 2) {
      for (const int foot : {tip - 1, tip + 1}) {
        builder.add_wall({foot, y}, {tip, y}, *arrowheads.wall_thickness_mm);
        builder.add_wall({foot, y}, {tip, y + 1}, *arrowheads.wall_thickness_mm);
      }
    }
  }
  return builder.take();
}

/// Stiffness of a wall of thickness t against a displacement (x, y) of its end, over E: x x, x y and y y.
struct WallStiffness {
  double xx;
  double xy;
  double yy;

  WallStiffness(const Vector2& direction, double thickness, double length) {
    const double axial = thickness / length;
    const double across = axial * axial * axial;
    xx = axial * direction.x() * direction.x() + across * direction.y() * direction.y();
    xy = (axial - across) * direction.x() * direction.y();
    yy = axial * direction.y() * direction.y() + across * direction.x() * direction.x();
  }
};

Vector2 period_of_arrowheads(const RegularLattice& arrowheads) {
  const double half_width = half_width_of(arrowheads);
  const double rise = tangent_of(own_number(arrowheads, kLongAngle)) - tangent_of(own_number(arrowheads, kShortAngle));
  return half_width * Vector2(2.0 * *arrowheads.columns, rise * *arrowheads.rows);
}

ClosedForms forms_of_arrowheads(const RegularLattice& arrowheads, LoadingSpec::Direction direction) {
  const double thickness = *arrowheads.wall_thickness_mm;
  const double b = half_width_of(arrowheads);
  const Vector2 to_tip = unit_direction(own_number(arrowheads, kLongAngle));
  const Vector2 to_notch = unit_direction(own_number(arrowheads, kShortAngle));
  const double tangents[] = {to_tip.y() / to_tip.x(), to_notch.y() / to_notch.x()};
  const double period = b * (tangents[0] - tangents[1]);
  const WallStiffness of_long(to_tip, thickness, b / to_tip.x());
  const WallStiffness of_short(to_notch, thickness, b / to_notch.x());
  const double yy = of_long.yy + of_short.yy;
  // Stresses from strains, with v from the balance of a tip; (b / p) and so on are those of the cell.
  const double pull = (of_long.xy + of_short.xy) / yy;  // -v over b e1
  const double share = of_long.yy / yy;                 // -v over p e2
  const double c11 = b / period * (of_long.xx + of_short.xx - pull * (of_long.xy + of_short.xy));
  const double c12 = of_long.xy - share * (of_long.xy + of_short.xy);
  const double c22 = period / b * of_long.yy * (1.0 - share);
  const double turn = tangents[0] / tangents[1];
  const double hinges = thickness * thickness * (turn + 1.0);
  ClosedForms forms = {.density = thickness * (b / to_tip.x() + b / to_notch.x()) / (b * period)};
  if (direction == LoadingSpec::Direction::x) {
    forms.modulus = c11 - c12 * c12 / c22;
    forms.poissons_ratio = c12 / c22;
    forms.collapse_stress = hinges / (2.0 * period * b * tangents[0]);
  } else {
    forms.modulus = c22 - c12 * c12 / c11;
    forms.poissons_ratio = c12 / c11;
    forms.collapse_stress = hinges / (2.0 * b * b * (turn - 1.0));
  }
  return forms;
}

}  // namespace

const LatticeKind& arrowhead_lattice() {
  static const LatticeKind kKind = {
      .name = "arrowhead",
      .plural = "arrowheads",
      .walls_per_cell = 4.0,
      .step_cost = 1.13,
      .own_numbers = {{kLongAngle, [](const RegularLattice&) { return 60.0; }},
                      {kShortAngle, [](const RegularLattice&) { return 30.0; }}},
      .check = check_arrowheads,
      .lay_out = lay_out_arrowheads,
      .period = period_of_arrowheads,
      .closed_forms = forms_of_arrowheads,
      .walls_of_cell = walls_of_arrowhead,
      .theory_note =
          [](const RegularLattice&) { return note_of_turning_walls("0.6 along x and, as they close, 3.9 along y"); },
  };
  return kKind;
}

}  // namespace cellcrush

#include <array>
#include <cmath>
#include <set>

#include "fields/field_checker.h"
#include "geometry/unit_direction.h"
#include "lattice/lattice.h"
#include "lattice/layout.h"
#include "lattice/period.h"

// Hexagons with walls of height h along y and walls of length l at the cell angle theta to x; below 0 they are
// re-entrant. Rows run along x, from the bottom up, and have `columns` and `columns - 1` cells in turn.
//
// Closed forms, with s = sin theta, c = cos theta, r = t/l, the thickness t_v of the walls along y and the load P of a
// slanted wall. Under a stress along x, P = sigma (h + l s), it bends under P s and is pressed by P c; the walls along
// y bear nothing. Under a stress along y, P = sigma l c, it bends under P c and is pressed by P s; the walls along y
// bear 2 P. A wall of unit depth, both ends of which stay at their angles, gives l^3 / (E t^3) to a unit shear force
// and l / (E t) to a unit axial one. Hence E* and nu*, exact for beams without shear; Gibson and Ashby, Cellular
// Solids, 2nd ed., section 4.2, without the walls' axial stretch. Collapse: plastic hinges at the ends of the slanted
// walls, section 4.3; at small angles along x these yield axially first.
namespace cellcrush {
namespace {

constexpr const char* kVertical = "vertical_wall_thickness_mm";
constexpr const char* kAngle = "angle_degrees";
constexpr const char* kHeight = "height_mm";

/// Half pitches in x; in y, three levels a row.
JointGrid grid_of_hexagons(const RegularLattice& hexagons) {
  const Vector2 slanted = *hexagons.side_mm * unit_direction(own_number(hexagons, kAngle));
  const double rest = own_number(hexagons, kHeight) - 2.0 * slanted.y();  // exactly 0 in regular hexagons
  return {{2 * *hexagons.columns + 1, 3 * *hexagons.rows + 1}, [slanted, rest](const GridPoint& point) -> Vector2 {
            const int walls_below = point.y() / 3;
            return {slanted.x() * point.x(), slanted.y() * point.y() + rest * walls_below};
          }};
}

void check_stiff_rows(const RegularLattice& hexagons, const Inclusions& inclusions, double side, FieldChecker& check) {
  for (std::size_t i = 0; i < inclusions.rows.size(); ++i) {
    check.in_range("lattice.inclusions.rows[" + std::to_string(i) + "]", inclusions.rows[i],
                   {1.0, static_cast<double>(hexagons.rows.value_or(10000))}, " (a row of cells, from the bottom)");
  }
  const std::set<int> stiff(inclusions.rows.begin(), inclusions.rows.end());
  if (inclusions.model == Inclusions::Model::rigid && hexagons.rows &&
      static_cast<int>(stiff.size()) >= *hexagons.rows) {
    check.add("lattice.inclusions.rows", std::to_string(stiff.size()) + " rows", "leaves no deformable cell.",
              "Remove a row, or set lattice.inclusions.model to MESHED.");
  }
  const double thickness = std::max(hexagons.wall_thickness_mm.value_or(0.0), own_number(hexagons, kVertical));
  if (check.within_limits("lattice.inclusions.thickness_factor", inclusions.thickness_factor) &&
      inclusions.thickness_factor * thickness > 0.5 * side) {
    check.add("lattice.inclusions.thickness_factor", to_text(inclusions.thickness_factor),
              "makes the stiff walls thicker than half of their length.",
              "Give at most " + to_text(0.5 * side / thickness) + ".");
  }
}

void check_hexagons(const SceneSpec& spec, double side, FieldChecker& check) {
  const RegularLattice& hexagons = *regular_lattice_of(spec);
  const double height = own_number(hexagons, kHeight);
  const double thickness = hexagons.wall_thickness_mm.value_or(0.0);
  const double drop = -2.0 * side * unit_direction(own_number(hexagons, kAngle)).y();  // of re-entrant walls
  if (std::isfinite(side) && height - drop < thickness) {
    check.add("lattice.hexagon.angle_degrees", to_text(own_number(hexagons, kAngle)),
              "makes the slanted walls of a re-entrant cell meet.",
              "Give a height_mm of at least " + to_text(drop + thickness) + ", or an angle closer to 0.");
  }
  if (!spec.inclusions.rows.empty()) {
    check_stiff_rows(hexagons, spec.inclusions, std::min(side, height), check);
  }
}

Layout lay_out_hexagons(const SceneSpec& spec) {
  const RegularLattice& hexagons = *regular_lattice_of(spec);
  const Inclusions& inclusions = spec.inclusions;
  WallBuilder builder(grid_of_hexagons(hexagons));
  const double slanted = *hexagons.wall_thickness_mm;
  const double upright = own_number(hexagons, kVertical);
  const bool repeats = repeats_along(spec, 0);
  for (int row = 0; row < *hexagons.rows; ++row) {
    const bool stiff = std::ranges::count(inclusions.rows, row + 1) > 0;
    const double factor = stiff ? inclusions.thickness_factor : 1.0;
    const bool rigid = stiff && inclusions.model == Inclusions::Model::rigid;
    // Odd rows are shifted by half a pitch. They are one cell shorter, or else lead across the sides.
    const int shift = row % 2;
    for (int column = 0; column < *hexagons.columns - (repeats ? 0 : shift); ++column) {
      const int x = 2 * column + shift;
      const int y = 3 * row;
      // Corners counter-clockwise from the lowest; walls 1-2 and 4-5 run along y.
      const std::array<GridPoint, 6> corner = {
          {{x + 1, y}, {x + 2, y + 1}, {x + 2, y + 3}, {x + 1, y + 4}, {x, y + 3}, {x, y + 1}}};
      for (int i = 0; i < 6; ++i) {
        builder.add_wall(corner[i], corner[(i + 1) % 6], factor * (i == 1 || i == 4 ? upright : slanted), rigid);
      }
    }
  }
  return builder.take();
}

Vector2 period_of_hexagons(const RegularLattice& hexagons) {
  const Vector2 period = grid_of_hexagons(hexagons).place({2 * *hexagons.columns, 3 * *hexagons.rows});
  return {period.x(), *hexagons.rows % 2 == 0 ? period.y() : 0.0};
}

ClosedForms forms_of_hexagons(const RegularLattice& hexagons, LoadingSpec::Direction direction) {
  const double ratio = *hexagons.wall_thickness_mm / *hexagons.side_mm;
  const double squared = ratio * ratio;
  const double upright = own_number(hexagons, kVertical) / *hexagons.wall_thickness_mm;  // t_v / t
  const double height = own_number(hexagons, kHeight) / *hexagons.side_mm;               // h / l
  const Vector2 slanted = unit_direction(own_number(hexagons, kAngle));
  const double c = slanted.x();
  const double s = slanted.y();
  const double pitch = height + s;  // of the rows, over l
  ClosedForms forms = {.density = ratio * (height * upright + 2.0) / (2.0 * c * pitch)};
  if (direction == LoadingSpec::Direction::x) {
    const double compliance = s * s + c * c * squared;
    forms.modulus = ratio * squared * c / (pitch * compliance);
    forms.poissons_ratio = s * c * c * (1.0 - squared) / (pitch * compliance);
    forms.collapse_stress = std::min(squared / (2.0 * pitch * std::abs(s)), ratio / (pitch * c));
  } else {
    const double compliance = c * c + squared * (s * s + 2.0 * height / upright);
    forms.modulus = ratio * squared * pitch / (c * compliance);
    forms.poissons_ratio = s * pitch * (1.0 - squared) / compliance;
    forms.collapse_stress = squared / (2.0 * c * c);
  }
  return forms;
}

std::vector<Vector2> walls_of_hexagon(const RegularLattice& hexagons) {
  const Vector2 slanted = hexagons.side_mm.value_or(0.0) * unit_direction(own_number(hexagons, kAngle));
  return {{0.0, own_number(hexagons, kHeight)}, slanted, {slanted.x(), -slanted.y()}};
}

std::string note_of_hexagons(const RegularLattice& hexagons) {
  const bool are_regular =
      own_number(hexagons, kAngle) == 30.0 && own_number(hexagons, kHeight) == hexagons.side_mm.value_or(0.0);
  return are_regular ? "" : note_of_turning_walls("0.3 to 0.9");
}

}  // namespace

const LatticeKind& hexagon_lattice() {
  static const LatticeKind kKind = {
      .name = "hexagon",
      .plural = "hexagons",
      .walls_per_cell = 3.0,
      .has_rows_of_cells = true,
      .own_numbers = {{kVertical, [](const RegularLattice& its) { return its.wall_thickness_mm.value_or(0.0); }, 0.5},
                      {kAngle, [](const RegularLattice&) { return 30.0; }},
                      {kHeight, [](const RegularLattice& its) { return its.side_mm.value_or(0.0); }}},
      .check = check_hexagons,
      .lay_out = lay_out_hexagons,
      .period = period_of_hexagons,
      .closed_forms = forms_of_hexagons,
      .walls_of_cell = walls_of_hexagon,
      .theory_note = note_of_hexagons,
  };
  return kKind;
}

}  // namespace cellcrush

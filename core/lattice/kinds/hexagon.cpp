#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <sstream>

#include "fields/field_checker.h"
#include "lattice/lattice.h"
#include "lattice/layout.h"

// Regular hexagons with walls along y. Rows run along x, from the bottom up, and have `columns` and `columns - 1` cells
// in turn.
namespace cellcrush {
namespace {

constexpr const char* kVertical = "vertical_wall_thickness_mm";

double vertical_thickness_of(const RegularLattice& hexagons) {
  const auto given = hexagons.own.find(kVertical);
  return given == hexagons.own.end() ? hexagons.wall_thickness_mm.value_or(0.0) : given->second;
}

/// Half pitches in x, half sides in y.
JointGrid grid_of_hexagons(const SceneSpec& spec) {
  const RegularLattice& hexagons = *regular_lattice_of(spec);
  const double side = *hexagons.side_mm;
  return {{2 * *hexagons.columns, 3 * *hexagons.rows + 1}, {0.5 * std::numbers::sqrt3 * side, 0.5 * side}};
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
  const double thickness = std::max(hexagons.wall_thickness_mm.value_or(0.0), vertical_thickness_of(hexagons));
  if (check.within_limits("lattice.inclusions.thickness_factor", inclusions.thickness_factor) &&
      inclusions.thickness_factor * thickness > 0.5 * side) {
    check.add("lattice.inclusions.thickness_factor", to_text(inclusions.thickness_factor),
              "makes the stiff walls thicker than half of side_mm.",
              "Give at most " + to_text(0.5 * side / thickness) + ".");
  }
}

void check_hexagons(const SceneSpec& spec, double side, FieldChecker& check) {
  const RegularLattice& hexagons = *regular_lattice_of(spec);
  const auto given = hexagons.own.find(kVertical);
  if (given != hexagons.own.end()) {
    check.in_range("lattice.hexagon.vertical_wall_thickness_mm", given->second, {1e-6, 0.5 * side}, half_of_side(side));
  }
  if (!spec.inclusions.rows.empty()) {
    check_stiff_rows(hexagons, spec.inclusions, side, check);
  }
}

Layout lay_out_hexagons(const SceneSpec& spec) {
  const RegularLattice& hexagons = *regular_lattice_of(spec);
  const Inclusions& inclusions = spec.inclusions;
  WallBuilder builder(grid_of_hexagons(spec), *spec.elements_per_wall);
  const double slanted = *hexagons.wall_thickness_mm;
  const double upright = vertical_thickness_of(hexagons);
  for (int row = 0; row < *hexagons.rows; ++row) {
    const bool stiff = std::ranges::count(inclusions.rows, row + 1) > 0;
    const double factor = stiff ? inclusions.thickness_factor : 1.0;
    const bool rigid = stiff && inclusions.model == Inclusions::Model::rigid;
    const int shift = row % 2;  // odd rows are one cell shorter and are shifted by half a pitch
    for (int column = 0; column < *hexagons.columns - shift; ++column) {
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

/// Walls bend: (2/3) sigma_y (h/L)^2 in either direction, with the thickness of the slanted walls (Gibson and Ashby,
/// Cellular Solids, 2nd ed., section 4.3).
double collapse_stress_of_hexagons(const SceneSpec& spec) {
  const RegularLattice& hexagons = *regular_lattice_of(spec);
  const double slenderness = *hexagons.wall_thickness_mm / *hexagons.side_mm;
  return 2.0 / 3.0 * *spec.material.yield_stress_mpa * slenderness * slenderness;
}

// STANDARD is the coarsest mesh whose plateau stresses lie within 4 % (impact) and 10 % (support) of a mesh twice as
// fine, at 25 to 200 m/s. Along y some differences of 8 elements exceed the bounds (core/what-is-computed.md).
DefaultMesh mesh_of_hexagons(const SceneSpec& spec) {
  constexpr double kSlow = 25.0;  // m/s; above it, walls along the crush need more than 2 elements
  if (spec.loading.direction == LoadingSpec::Direction::y && spec.loading.speed_m_per_s.value_or(0.0) > kSlow) {
    return {2, 8, 16, "hexagons crushed along y faster than 25 m/s"};
  }
  return {1, 2, 8, "hexagons"};
}

std::string walls_of_hexagons(const RegularLattice& hexagons) {
  const double upright = vertical_thickness_of(hexagons);
  if (upright == hexagons.wall_thickness_mm.value_or(0.0)) {
    return {};
  }
  std::ostringstream text;
  text << "along y " << upright << " mm";
  return text.str();
}

}  // namespace

const LatticeKind& hexagon_lattice() {
  static const LatticeKind kKind = {
      .name = "hexagon",
      .plural = "hexagons",
      .walls_per_cell = 3.0,
      .has_rows_of_cells = true,
      .own_numbers = {{kVertical, [](const RegularLattice& hexagons) { return *hexagons.wall_thickness_mm; }}},
      .check = check_hexagons,
      .envelope = [](const SceneSpec& spec) { return grid_of_hexagons(spec).envelope(); },
      .lay_out = lay_out_hexagons,
      .collapse_stress = collapse_stress_of_hexagons,
      .mesh = mesh_of_hexagons,
      .walls_in_words = walls_of_hexagons,
  };
  return kKind;
}

}  // namespace cellcrush

#include <cmath>
#include <numbers>
#include <vector>

#include "lattice/lattice.h"
#include "lattice/layout.h"

// Regular hexagons of which every joint is a small hexagon of side gamma l instead (Ajdari, Jahromi, Papadopoulos,
// Nayeb-Hashemi and Vaziri, Int. J. Solids Struct. 49 (2012), 1413). Rows and columns are those of the hexagons.
//
// Closed forms of slender walls, with r = t/l: E* = sqrt 3 E r^3 / D and nu* = 1 - gamma^3 / D, with D = 0.75 - 3.525
// gamma + 3.6 gamma^2 + 2.9 gamma^3. The walls' axial
// stretch, which they leave out, lowers the modulus: at gamma = 0.3 by 25 r^2 of it.
namespace cellcrush {

const LatticeKind& hexagon_lattice();

namespace {

constexpr const char* kSmallSide = "small_side_mm";

/// The corner of a small hexagon that lies in a direction: 0 at 30 degrees, then counter-clockwise.
int corner_towards(const Vector2& direction) {
  const double across = direction.x() / direction.norm();
  const int column = across > 0.5 ? 1 : across < -0.5 ? -1 : 0;
  if (direction.y() > 0.0) return 1 - column;
  return 4 + column;
}

Layout lay_out_hierarchical_hexagons(const SceneSpec& spec) {
  SceneSpec plain = spec;
  RegularLattice& hexagons = std::get<RegularLattice>(plain.lattice);
  hexagons.kind = "hexagon";
  hexagons.own.clear();
  const Layout large = hexagon_lattice().lay_out(plain);
  const double small = own_number(*regular_lattice_of(spec), kSmallSide);
  const double across = 0.5 * std::numbers::sqrt3 * small;
  const Vector2 corner[] = {{across, 0.5 * small},   {0.0, small},  {-across, 0.5 * small},
                            {-across, -0.5 * small}, {0.0, -small}, {across, -0.5 * small}};
  Layout layout;
  const auto add_wall = [&](int start, int end) {
    layout.walls.push_back({start, end, *hexagons.wall_thickness_mm, *spec.elements_per_wall});
  };
  for (const Vector2& joint : large.joints) {
    const int first = static_cast<int>(layout.joints.size());
    for (int i = 0; i < 6; ++i) {
      layout.joints.push_back(joint + corner[i]);
      add_wall(first + i, first + (i + 1) % 6);
    }
  }
  for (const LayoutWall& wall : large.walls) {
    const int towards = corner_towards(large.joints[wall.end] - large.joints[wall.start]);
    add_wall(6 * wall.start + towards, 6 * wall.end + (towards + 3) % 6);
  }
  return layout;
}

ClosedForms forms_of_hierarchical_hexagons(const RegularLattice& hexagons, LoadingSpec::Direction) {
  const double ratio = *hexagons.wall_thickness_mm / *hexagons.side_mm;
  const double gamma = own_number(hexagons, kSmallSide) / *hexagons.side_mm;
  const double cube = gamma * gamma * gamma;
  const double compliance = 0.75 - 3.525 * gamma + 3.6 * gamma * gamma + 2.9 * cube;
  return {.density = 2.0 / std::numbers::sqrt3 * (1.0 + 2.0 * gamma) * ratio,
          .modulus = std::numbers::sqrt3 * ratio * ratio * ratio / compliance,
          .poissons_ratio = 1.0 - cube / compliance};
}

}  // namespace

const LatticeKind& hierarchical_hexagon_lattice() {
  static const LatticeKind kKind = {
      .name = "hierarchical_hexagon",
      .plural = "hierarchical hexagons",
      .walls_per_cell = 15.0,
      .own_numbers = {{kSmallSide, [](const RegularLattice& its) { return 0.3 * its.side_mm.value_or(0.0); }, 0.49}},
      .lay_out = lay_out_hierarchical_hexagons,
      .closed_forms = forms_of_hierarchical_hexagons,
      .theory_note = "The quasi-static stress of hierarchical hexagons is not known, so no theory is drawn.",
  };
  return kKind;
}

}  // namespace cellcrush

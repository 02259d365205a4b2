#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "lattice/lattice.h"
#include "lattice/layout.h"

// Regular hexagons of which every joint is a small hexagon of side gamma l instead (Ajdari, Jahromi, Papadopoulos,
// Nayeb-Hashemi and Vaziri, Int. J. Solids Struct. 49 (2012), 1413). Rows and columns are those of the hexagons.
//
// Moduli. The middle of a large wall is a centre of inversion and bears no moment, so that a stress sigma loads the
// three large walls of a joint by sqrt 3 l sigma d there, d their directions. In the ring of six walls between them a
// force and a moment about its middle go round, which change at the large walls and are those of least energy. Exact
// for beams without shear. Slender walls have E* = sqrt 3 E r^3 / D and nu* = 1 - gamma^3 / D, with r = t/l and D =
// 0.75 - 3.525 gamma + 3.6 gamma^2 + 2.9 gamma^3.
namespace cellcrush {

const LatticeKind& hexagon_lattice();

namespace {

constexpr const char* kSmallSide = "small_side_mm";

/// Corners of a small hexagon from its middle: that at 30 degrees, then counter-clockwise.
std::array<Vector2, 6> corners_of(double side) {
  const double across = 0.5 * std::numbers::sqrt3 * side;
  return {{{across, 0.5 * side},
           {0.0, side},
           {-across, 0.5 * side},
           {-across, -0.5 * side},
           {0.0, -side},
           {across, -0.5 * side}}};
}

/// The corner of a small hexagon that lies in a direction: 0 at 30 degrees, then counter-clockwise.
int corner_towards(const Vector2& direction) {
  const double across = direction.x() / direction.norm();
  const int column = across > 0.5 ? 1 : across < -0.5 ? -1 : 0;
  if (direction.y() > 0.0) return 1 - column;
  return 4 + column;
}

/// The hexagons at whose joints the small ones stand.
RegularLattice plain_of(const RegularLattice& hexagons) {
  RegularLattice plain = hexagons;
  plain.kind = "hexagon";
  plain.own.clear();
  return plain;
}

Layout lay_out_hierarchical_hexagons(const SceneSpec& spec) {
  const RegularLattice hexagons = plain_of(*regular_lattice_of(spec));
  SceneSpec plain = spec;
  plain.lattice = hexagons;
  const Layout large = hexagon_lattice().lay_out(plain);
  const std::array<Vector2, 6> corner = corners_of(own_number(*regular_lattice_of(spec), kSmallSide));
  Layout layout;
  const auto add_wall = [&](int start, int end) { layout.walls.push_back({start, end, *hexagons.wall_thickness_mm}); };
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

std::vector<Vector2> walls_of_hierarchical_hexagon(const RegularLattice& hexagons) {
  const auto corner = corners_of(own_number(hexagons, kSmallSide));
  const double large = hexagons.side_mm.value_or(0.0) - 2.0 * own_number(hexagons, kSmallSide);
  std::vector<Vector2> walls;
  for (int of_two_joints = 0; of_two_joints < 2; ++of_two_joints) {
    for (std::size_t i = 0; i < corner.size(); ++i) walls.push_back(corner[(i + 1) % corner.size()] - corner[i]);
  }
  for (const std::size_t towards : {0, 2, 4}) walls.push_back(large * corner[towards].normalized());
  return walls;
}

/// Energy of a small hexagon and the halves of its large walls under a stress, with E and l of 1.
double energy_of_joint(const Eigen::Matrix2d& stress, double gamma, double thickness) {
  const double bending = 6.0 / (thickness * thickness * thickness);  // 1 / 2 E I
  const double axial = 0.5 / thickness;
  const double arm = 0.5 - gamma;  // of half a large wall
  const std::array<Vector2, 6> outwards_to = corners_of(1.0);
  Eigen::Matrix3d curvature = Eigen::Matrix3d::Zero();
  Eigen::Vector3d slope = Eigen::Vector3d::Zero();
  double energy = 0.0;  // energy + 2 slope z + z curvature z, of the force and the moment z in the first wall
  Eigen::Vector3d changed = Eigen::Vector3d::Zero();  // of force and moment, from the first wall to this one
  for (int i = 0; i < 6; ++i) {
    const Vector2 corner = gamma * outwards_to[i];
    const Vector2 next = gamma * outwards_to[(i + 1) % 6];
    if (i % 2 == 0) {
      const Vector2& outwards = outwards_to[i];
      const Vector2 force = std::numbers::sqrt3 * stress * outwards;
      const double across = cross(outwards, force);
      const double along = outwards.dot(force);
      energy += bending * across * across * arm * arm * arm / 3.0 + axial * along * along * arm;
      changed += Eigen::Vector3d(force.x(), force.y(), 0.5 * across);
    }
    const auto add = [&](const Eigen::Vector3d& share, double weight) {  // of the force and the moment
      const double own = share.dot(changed);
      energy += weight * own * own;
      slope += weight * own * share;
      curvature += weight * share * share.transpose();
    };
    const Vector2 direction = (next - corner) / gamma;
    add({direction.x(), direction.y(), 0.0}, axial * gamma);
    for (const int place : {0, 1, 2}) {  // start, middle and end: Simpson's rule
      const Vector2 point = corner + 0.5 * place * (next - corner);
      add({point.y(), -point.x(), 1.0}, bending * gamma * (place == 1 ? 4.0 : 1.0) / 6.0);
    }
  }
  return energy - slope.dot(curvature.ldlt().solve(slope));
}

Vector2 period_of_hierarchical_hexagons(const RegularLattice& hexagons) {
  return hexagon_lattice().period(plain_of(hexagons));
}

ClosedForms forms_of_hierarchical_hexagons(const RegularLattice& hexagons, LoadingSpec::Direction) {
  const double ratio = *hexagons.wall_thickness_mm / *hexagons.side_mm;
  const double gamma = own_number(hexagons, kSmallSide) / *hexagons.side_mm;
  const Eigen::Matrix2d both = Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d one = Eigen::Vector2d::UnitX().asDiagonal();
  const double area = 0.75 * std::numbers::sqrt3;  // of a joint
  const double modulus = 0.5 * area / energy_of_joint(one, gamma, ratio);
  return {.density = 2.0 / std::numbers::sqrt3 * (1.0 + 2.0 * gamma) * ratio,
          .modulus = modulus,
          .poissons_ratio = 1.0 - energy_of_joint(both, gamma, ratio) * modulus / area};
}

}  // namespace

const LatticeKind& hierarchical_hexagon_lattice() {
  static const LatticeKind kKind = {
      .name = "hierarchical_hexagon",
      .plural = "hierarchical hexagons",
      .walls_per_cell = 15.0,
      .step_cost = 0.67,
      .own_numbers = {{kSmallSide, [](const RegularLattice& its) { return 0.3 * its.side_mm.value_or(0.0); }, 0.49}},
      .lay_out = lay_out_hierarchical_hexagons,
      .period = period_of_hierarchical_hexagons,
      .closed_forms = forms_of_hierarchical_hexagons,
      .walls_of_cell = walls_of_hierarchical_hexagon,
      .theory_note =
          [](const RegularLattice&) {
            return std::string(
                "The quasi-static stress of hierarchical hexagons is not known: no theory of it applies.");
          },
  };
  return kKind;
}

}  // namespace cellcrush

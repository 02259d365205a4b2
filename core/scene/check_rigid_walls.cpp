#include "scene/check_rigid_walls.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cellcrush/scene.h"

namespace cellcrush {
namespace {

/// Depth to which a ball may stand in a wall at first, as a fraction of its radius: where it is placed on an oblique
/// wall, it does so by round-off.
constexpr double kRoundedDepth = 1e-6;

/// Radius of the ball of each node, mm: half of the thickness of its thickest beam.
std::vector<double> radii_of(const FrameLattice& frame) {
  std::vector<double> radii(frame.nodes.size(), 0.0);
  const auto widen = [&](int node, double thickness) {
    if (node >= 0 && node < static_cast<int>(radii.size())) {
      radii[node] = std::max(radii[node], 0.5 * thickness);
    }
  };
  for (const FrameLattice::Beam& beam : frame.beams) {
    widen(beam.start, beam.thickness_mm);
    widen(beam.end, beam.thickness_mm);
  }
  return radii;
}

/// Refuses a wall in which a node's ball stands at time 0. Beams are straight: no ball inside one is deeper.
void check_outside(const FrameLattice& frame, const std::string& path, const FrameLattice::RigidWall& wall,
                   FieldChecker& check) {
  const Vector2 normal = Vector2(wall.normal_x, wall.normal_y).stableNormalized();
  const double displacement = wall.points.empty() ? 0.0 : TimeFunction{wall.points}.value_at(0.0);
  const std::vector<double> radii = radii_of(frame);
  int deepest = -1;
  double most = 0.0;
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    const Vector2 from_face(frame.nodes[i].x_mm - wall.x_mm, frame.nodes[i].y_mm - wall.y_mm);
    const double depth = radii[i] + displacement - normal.dot(from_face);
    if (depth > kRoundedDepth * radii[i] && depth > most) {
      most = depth;
      deepest = static_cast<int>(i);
    }
  }
  if (deepest >= 0) {
    check.add(path, to_text(most) + " mm",
              "is the depth to which the beams at lattice.frame.nodes[" + std::to_string(deepest) +
                  "] stand in the wall at time 0, half of their thickness included.",
              "Move the wall back by at least that much, or turn its normal towards the frame.");
  }
}

}  // namespace

void check_rigid_walls(const FrameLattice& frame, FieldChecker& check) {
  if (!frame.rigid_walls.empty() && has_pins(frame)) {
    check.add("lattice.frame.rigid_walls", std::to_string(frame.rigid_walls.size()),
              "cannot be computed in a frame with pinned ends.",
              "Remove the rigid walls, or pin_start and pin_end of all beams.");
  }
  for (std::size_t i = 0; i < frame.rigid_walls.size(); ++i) {
    const FrameLattice::RigidWall& wall = frame.rigid_walls[i];
    const std::string path = "lattice.frame.rigid_walls[" + std::to_string(i) + "]";
    bool placed = check.within_limits(path + ".x_mm", wall.x_mm);
    placed = check.within_limits(path + ".y_mm", wall.y_mm) && placed;
    placed = check.within_limits(path + ".normal_x", wall.normal_x) && placed;
    placed = check.within_limits(path + ".normal_y", wall.normal_y) && placed;
    check.within_limits(path + ".friction", wall.friction);
    if (wall.normal_x == 0.0 && wall.normal_y == 0.0) {
      check.add(path + ".normal_x", "0", "and normal_y give no direction.",
                "Give the direction out of the wall, towards the frame.");
      placed = false;
    }
    if (!wall.points.empty()) {
      check_function_of_time(path + ".displacement_mm", wall.points, check);
    }
    if (placed) {
      check_outside(frame, path, wall, check);
    }
  }
}

}  // namespace cellcrush

#include "scene/rigid_joints.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "scene/mesh.h"

namespace cellcrush {
namespace {

constexpr double kLongestArm = 0.4;    // over the chord
constexpr double kShortestArm = 1e-3;  // the same; less is none

/// A wall at one of its joints.
struct WallAtJoint {
  double angle = 0.0;  ///< of the chord, away from the joint
  int wall = 0;
  bool at_end = false;
};

/// Where the face of a wall meets that of a neighbour, along the wall, mm.
double corner_of(double thickness, double of_neighbour, double angle) {
  constexpr double kInLine = 1e-6;
  if (angle >= std::numbers::pi - kInLine || angle <= kInLine) return 0.0;
  return std::max(0.0, 0.5 * (of_neighbour + thickness * std::cos(angle)) / std::sin(angle));
}

}  // namespace

std::vector<std::pair<double, double>> arms_of(const Layout& layout) {
  std::vector<std::vector<WallAtJoint>> at_joint(layout.joints.size());
  for (std::size_t w = 0; w < layout.walls.size(); ++w) {
    const LayoutWall& wall = layout.walls[w];
    const Vector2 span = layout.joints[wall.end] - layout.joints[wall.start];
    at_joint[wall.start].push_back({std::atan2(span.y(), span.x()), static_cast<int>(w), false});
    at_joint[wall.end].push_back({std::atan2(-span.y(), -span.x()), static_cast<int>(w), true});
  }
  std::vector<std::pair<double, double>> arms(layout.walls.size(), {0.0, 0.0});
  for (std::vector<WallAtJoint>& walls : at_joint) {
    std::ranges::sort(walls, {}, &WallAtJoint::angle);
    for (std::size_t i = 0; i < walls.size() && walls.size() > 1; ++i) {
      const WallAtJoint& next = walls[(i + 1) % walls.size()];
      const double turn = i + 1 == walls.size() ? 2.0 * std::numbers::pi : 0.0;
      const double angle = next.angle + turn - walls[i].angle;
      for (const auto& [of, neighbour] : {std::pair(walls[i], next), std::pair(next, walls[i])}) {
        const LayoutWall& wall = layout.walls[of.wall];
        const double corner = corner_of(wall.thickness, layout.walls[neighbour.wall].thickness, angle);
        (of.at_end ? arms[of.wall].second : arms[of.wall].first) += 0.5 * corner / layout.chord_of(wall);
      }
    }
  }
  for (std::size_t w = 0; w < arms.size(); ++w) {
    for (double* arm : {&arms[w].first, &arms[w].second}) {
      *arm = layout.walls[w].rigid || *arm < kShortestArm ? 0.0 : std::min(*arm, kLongestArm);
    }
  }
  return arms;
}

void add_rigid_joints(Layout& layout) {
  const std::vector<std::pair<double, double>> arms = arms_of(layout);
  std::vector<LayoutWall> rigid;
  std::vector<int> wall_of;
  for (std::size_t w = 0; w < arms.size(); ++w) wall_of.push_back(static_cast<int>(w));
  for (std::size_t w = 0; w < arms.size(); ++w) {
    const LayoutWall wall = layout.walls[w];
    const double from = arms[w].first;
    const double to = 1.0 - arms[w].second;
    LayoutWall free = wall;
    const auto cut = [&](int joint, double share) {
      const int added = static_cast<int>(layout.joints.size());
      layout.joints.push_back(place_on(layout, wall, share));
      rigid.push_back({joint, added, wall.thickness, 1, wall.material, true});
      wall_of.push_back(static_cast<int>(w));
      return added;
    };
    if (from > 0.0) free.start = cut(wall.start, from);
    if (to < 1.0) free.end = cut(wall.end, to);
    free.rise = rise_between(layout, wall, from, to);
    free.bow = 0.0;
    layout.walls[w] = free;
  }
  layout.walls.insert(layout.walls.end(), rigid.begin(), rigid.end());
  layout.order = ListOrder{{}, std::move(wall_of)}.after(layout.order);
  list_added_joints(layout);
}

}  // namespace cellcrush

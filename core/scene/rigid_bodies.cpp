#include "scene/rigid_bodies.h"

#include <algorithm>
#include <numeric>

namespace cellcrush {
namespace {

/// For each joint, the lowest of the joints to which rigid walls connect it; its own number if none does.
std::vector<int> find_parts(const Layout& layout) {
  std::vector<int> part(layout.joints.size());
  std::iota(part.begin(), part.end(), 0);
  const auto root_of = [&](int joint) {
    while (part[joint] != joint) {
      part[joint] = part[part[joint]];
      joint = part[joint];
    }
    return joint;
  };
  for (const LayoutWall& wall : layout.walls) {
    if (wall.rigid) {
      const auto [low, high] = std::minmax({root_of(wall.start), root_of(wall.end)});
      part[high] = low;
    }
  }
  for (int& joint : part) {
    joint = root_of(joint);
  }
  return part;
}

}  // namespace

std::vector<int> put_rigid_bodies_first(Layout& layout) {
  const auto rigid_begin = std::stable_partition(layout.walls.begin(), layout.walls.end(),
                                                 [](const LayoutWall& wall) { return !wall.rigid; });
  if (rigid_begin == layout.walls.end()) {
    return {};
  }
  const std::vector<int> part = find_parts(layout);
  std::vector<bool> is_rigid(layout.joints.size(), false);
  for (auto wall = rigid_begin; wall != layout.walls.end(); ++wall) {
    is_rigid[wall->start] = true;
    is_rigid[wall->end] = true;
  }
  std::vector<int> order(layout.joints.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    return is_rigid[a] != is_rigid[b] ? is_rigid[a] : is_rigid[a] && part[a] < part[b];
  });

  std::vector<int> offset;
  std::vector<int> number(order.size());
  std::vector<Vector2> joints;
  for (const int joint : order) {
    const auto place = static_cast<int>(joints.size());
    const bool begins_body = is_rigid[joint] && (place == 0 || part[order[place - 1]] != part[joint]);
    if (begins_body || (!is_rigid[joint] && is_rigid[order[place - 1]])) {
      offset.push_back(place);
    }
    number[joint] = place;
    joints.push_back(layout.joints[joint]);
  }
  if (is_rigid[order.back()]) {
    offset.push_back(static_cast<int>(joints.size()));
  }
  layout.joints = std::move(joints);
  for (LayoutWall& wall : layout.walls) {
    wall.start = number[wall.start];
    wall.end = number[wall.end];
  }
  return offset;
}

void lump_rigid_bodies(Scene& scene) {
  RigidBodies& rigid = scene.rigid;
  for (std::size_t body = 0; body + 1 < rigid.offset.size(); ++body) {
    double mass = 0.0;
    Vector2 moment = Vector2::Zero();
    for (int i = rigid.offset[body]; i < rigid.offset[body + 1]; ++i) {
      mass += scene.mass[i];
      moment += scene.mass[i] * scene.position[i];
    }
    const Vector2 centre = moment / mass;
    double inertia = 0.0;
    for (int i = rigid.offset[body]; i < rigid.offset[body + 1]; ++i) {
      inertia += scene.inertia[i] + scene.mass[i] * (scene.position[i] - centre).squaredNorm();
    }
    rigid.centre.push_back(centre);
    rigid.mass.push_back(mass);
    rigid.inertia.push_back(inertia);
  }
}

}  // namespace cellcrush

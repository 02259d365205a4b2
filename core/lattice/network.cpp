#include "lattice/network.h"

namespace cellcrush {
namespace {

Vector2 joint_of(const NetworkWalls& network, int joint) {
  return {network.joints_mm[2 * joint], network.joints_mm[2 * joint + 1]};
}

}  // namespace

Layout lay_out_network(const NetworkWalls& network, int links) {
  Layout layout;
  layout.joints.reserve(network.joint_count());
  for (std::size_t joint = 0; joint < network.joint_count(); ++joint) {
    layout.joints.push_back(joint_of(network, static_cast<int>(joint)));
  }
  layout.walls.reserve(network.wall_count());
  for (std::size_t wall = 0; wall < network.wall_count(); ++wall) {
    LayoutWall& added = layout.walls.emplace_back();
    added.start = network.walls[2 * wall];
    added.end = network.walls[2 * wall + 1];
    added.thickness = network.thicknesses_mm.empty() ? *network.wall_thickness_mm : network.thicknesses_mm[wall];
    added.rigid = wall + links >= network.wall_count();
    added.material = network.wall_materials.empty() ? 0 : network.wall_materials[wall];
    added.rise = network.rises_mm.empty() ? 0.0 : network.rises_mm[wall];
  }
  return layout;
}

bool has_stacked_walls(const NetworkWalls& network) { return network.walls.size() > 3 * network.joint_count(); }

}  // namespace cellcrush

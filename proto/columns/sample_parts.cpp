#include "columns/sample_parts.h"

namespace cellcrush {

v1::Sample sample_parts_of(const v1::Case& submitted) {
  v1::Sample out;
  const v1::Frame& frame = submitted.lattice().frame();
  const v1::Loading& loading = submitted.loading();
  for (const auto& node : frame.watched_nodes()) out.add_watched()->set_node(node);
  for (const auto* walls : {&frame.rigid_walls(), &loading.rigid_walls()}) {
    for (const auto& wall : *walls) out.add_rigid_walls()->set_wall(wall.id());
  }
  if (loading.sides().kind() == v1::Loading::Sides::RIGID) {
    for (const char* id : kSideWallIds) out.add_rigid_walls()->set_wall(id);
  }
  for (const auto& grip : loading.grips()) out.add_grips()->set_grip(grip.id());
  return out;
}

}  // namespace cellcrush

#include "scene/layout_builder.h"

#include <algorithm>

namespace cellcrush {

LayoutBuilder::LayoutBuilder(const Vector2& unit, int elements_per_wall)
    : unit_(unit), elements_per_wall_(elements_per_wall) {}

void LayoutBuilder::add_wall(GridPoint from, GridPoint to, double thickness) {
  const int start = joint(from);
  const int end = joint(to);
  const auto [entry, is_new] = walls_.emplace(std::minmax(start, end), layout_.walls.size());
  if (is_new) {
    layout_.walls.push_back({start, end, thickness, elements_per_wall_});
  } else {
    double& existing = layout_.walls[entry->second].thickness;
    existing = std::max(existing, thickness);
  }
}

int LayoutBuilder::joint(GridPoint point) {
  const auto [entry, is_new] = joints_.emplace(point, static_cast<int>(layout_.joints.size()));
  if (is_new) {
    layout_.joints.emplace_back(unit_.x() * point.first, unit_.y() * point.second);
  }
  return entry->second;
}

}  // namespace cellcrush

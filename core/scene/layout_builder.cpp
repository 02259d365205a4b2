#include "scene/layout_builder.h"

#include <algorithm>

namespace cellcrush {
namespace {

std::uint64_t bits_of(const std::pair<int, int>& pair) {
  return std::uint64_t{static_cast<std::uint32_t>(pair.first)} << 32U | static_cast<std::uint32_t>(pair.second);
}

}  // namespace

LayoutBuilder::LayoutBuilder(const Vector2& unit, int elements_per_wall)
    : unit_(unit), elements_per_wall_(elements_per_wall) {}

void LayoutBuilder::add_wall(GridPoint from, GridPoint to, double thickness, bool rigid) {
  const int start = joint(from);
  const int end = joint(to);
  const auto [entry, is_new] = walls_.emplace(bits_of(std::minmax(start, end)), layout_.walls.size());
  if (is_new) {
    layout_.walls.push_back({start, end, thickness, elements_per_wall_, 0, rigid});
  } else {
    LayoutWall& existing = layout_.walls[entry->second];
    existing.thickness = std::max(existing.thickness, thickness);
    existing.rigid = existing.rigid || rigid;
  }
}

int LayoutBuilder::joint(GridPoint point) {
  const auto [entry, is_new] = joints_.emplace(bits_of(point), static_cast<int>(layout_.joints.size()));
  if (is_new) {
    layout_.joints.emplace_back(unit_.x() * point.first, unit_.y() * point.second);
  }
  return entry->second;
}

}  // namespace cellcrush

#include "scene/number_columns.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <tuple>
#include <utility>

#include "scene/bands.h"

namespace cellcrush {
namespace {

bool is_longer_along_x(const std::vector<Vector2>& places) {
  Vector2 low = places.front();
  Vector2 high = low;
  for (const Vector2& place : places) {
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  return (high - low).x() > (high - low).y();
}

bool concerns(const std::vector<Vector2>& places, const Layout& layout) {
  std::size_t elements = 0;
  bool has_rigid = false;
  for (const LayoutWall& wall : layout.walls) {
    elements += static_cast<std::size_t>(wall.elements);
    has_rigid = has_rigid || wall.rigid;
  }
  return elements >= kLeastElementsOfBands && !has_rigid && is_longer_along_x(places);
}

}  // namespace

void number_columns(const std::vector<Vector2>& places, Layout& layout) {
  if (!concerns(places, layout)) {
    return;
  }
  std::vector<int> order(places.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::tie(places[a].x(), places[a].y()) < std::tie(places[b].x(), places[b].y());
  });
  std::vector<int> number(order.size());
  std::vector<Vector2> joints(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    number[order[i]] = static_cast<int>(i);
    joints[i] = layout.joints[order[i]];
  }
  layout.joints = std::move(joints);
  for (LayoutWall& wall : layout.walls) {
    wall.start = number[wall.start];
    wall.end = number[wall.end];
  }
  std::sort(layout.walls.begin(), layout.walls.end(), [](const LayoutWall& a, const LayoutWall& b) {
    return std::minmax(a.start, a.end) < std::minmax(b.start, b.end);
  });
}

}  // namespace cellcrush

#include "lattice/layout.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "cellcrush/tuning.h"
#include "geometry/find_parts.h"
#include "lattice/draw.h"

namespace cellcrush {
namespace {

/// Walls that pass one which waits for its block (fill_blocks).
constexpr std::size_t kMostWait = 1024;

/// Whether walls that are not rigid differ in their numbers of elements.
bool is_uneven(const Layout& layout) {
  const auto first = std::ranges::find(layout.walls, false, &LayoutWall::rigid);
  return std::any_of(first, layout.walls.end(),
                     [&](const LayoutWall& wall) { return !wall.rigid && wall.elements != first->elements; });
}

bool is_longer_along_x(const std::vector<Vector2>& places) {
  const Vector2 extent = envelope_of(places);
  return extent.x() > extent.y();
}

std::vector<int> numbers_of(std::size_t count) {
  std::vector<int> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

double length_of(const Layout& layout, const LayoutWall& wall) {
  const double chord = layout.chord_of(wall);
  if (wall.rise == 0.0) return chord;
  const double half_angle = 2.0 * std::atan(2.0 * std::abs(wall.rise) / chord);
  return chord * half_angle / std::sin(half_angle);
}

/// Puts the joints into the order given by their present numbers.
void reorder_joints(const std::vector<int>& order, Layout& layout) {
  const std::vector<int> number = places_of(order);
  layout.joints = reordered(layout.joints, order);
  layout.order = ListOrder{order, {}}.after(layout.order);
  for (LayoutWall& wall : layout.walls) {
    wall.start = number[wall.start];
    wall.end = number[wall.end];
  }
  for (auto& [low, high] : layout.images) {
    low = number[low];
    high = number[high];
  }
}

void reorder_walls(const std::vector<int>& order, Layout& layout) {
  layout.walls = reordered(layout.walls, order);
  layout.order = ListOrder{{}, order}.after(layout.order);
}

}  // namespace

std::vector<int> places_of(const std::vector<int>& order) {
  std::vector<int> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) place[order[i]] = static_cast<int>(i);
  return place;
}

Bounds bounds_of(const std::vector<Vector2>& points) {
  Bounds bounds = {points.front(), points.front()};
  for (const Vector2& point : points) {
    bounds.low = bounds.low.cwiseMin(point);
    bounds.high = bounds.high.cwiseMax(point);
  }
  return bounds;
}

Vector2 envelope_of(const std::vector<Vector2>& joints) {
  const auto [low, high] = bounds_of(joints);
  return high - low;
}

void divide_walls(int elements_of_mean, Layout& layout) {
  double sum = 0.0;
  for (const LayoutWall& wall : layout.walls) sum += length_of(layout, wall);
  const double per_mm = elements_of_mean * static_cast<double>(layout.walls.size()) / sum;
  for (LayoutWall& wall : layout.walls) {
    if (!wall.rigid) wall.elements = std::max(1, static_cast<int>(std::lround(per_mm * length_of(layout, wall))));
  }
}

void perturb(const Imperfection& imperfection, Layout& layout) {
  if (imperfection.amplitude_mm == 0.0) {
    return;
  }
  constexpr double kShare = 0.125;  // of the shortest wall: its joints keep their order
  std::vector<double> amplitudes(layout.joints.size(), imperfection.amplitude_mm);
  for (const LayoutWall& wall : layout.walls) {
    const double most = kShare * length_of(layout, wall);
    for (const int joint : {wall.start, wall.end}) amplitudes[joint] = std::min(amplitudes[joint], most);
  }
  Draw draw(imperfection.seed);
  for (std::size_t i = 0; i < layout.joints.size(); ++i) {
    layout.joints[i].x() += amplitudes[i] * draw.next();
    layout.joints[i].y() += amplitudes[i] * draw.next();
  }
}

void bow(const Imperfection& imperfection, std::vector<LayoutWall>& walls) {
  if (imperfection.bow_mm == 0.0) {
    return;
  }
  Draw draw(~imperfection.seed);
  for (LayoutWall& wall : walls) {
    wall.bow += imperfection.bow_mm * draw.next();
  }
}

void number_columns(const std::vector<Vector2>& places, int crush_axis, Layout& layout) {
  const bool may_have_bands = layout.element_count() >= kLeastElementsOfBands && layout.images.empty() &&
                              is_longer_along_x(places) && std::ranges::none_of(layout.walls, &LayoutWall::rigid);
  if (!may_have_bands && !is_uneven(layout)) return;
  const int along = may_have_bands ? 0 : crush_axis;
  std::vector<int> order = numbers_of(places.size());
  std::ranges::sort(order, {}, [&](int joint) { return std::tie(places[joint][along], places[joint][1 - along]); });
  reorder_joints(order, layout);
  std::vector<int> walls = numbers_of(layout.walls.size());
  std::ranges::sort(walls, {}, [&](int wall) {
    return std::tuple_cat(std::minmax({layout.walls[wall].start, layout.walls[wall].end}), std::tuple(wall));
  });
  reorder_walls(walls, layout);
}

std::vector<int> put_rigid_bodies_first(Layout& layout) {
  if (std::ranges::none_of(layout.walls, &LayoutWall::rigid)) {
    return {};
  }
  std::vector<int> walls = numbers_of(layout.walls.size());
  const auto of_rigid = std::ranges::stable_partition(walls, [&](int wall) { return !layout.walls[wall].rigid; });
  reorder_walls(walls, layout);
  const std::span<const LayoutWall> rigid_walls = std::span(layout.walls).last(of_rigid.size());
  const auto deformable = static_cast<int>(layout.joints.size());
  const std::vector<int> part = find_parts(layout.joints.size(), rigid_walls);
  std::vector<int> body(layout.joints.size(), deformable);
  for (const LayoutWall& wall : rigid_walls) {
    body[wall.start] = body[wall.end] = part[wall.start];
  }
  std::vector<int> order = numbers_of(layout.joints.size());
  std::ranges::stable_sort(order, {}, [&](int joint) { return body[joint]; });
  std::vector<int> offset = {0};
  for (std::size_t place = 1; place <= order.size() && body[order[place - 1]] != deformable; ++place) {
    if (place == order.size() || body[order[place]] != body[order[place - 1]]) {
      offset.push_back(static_cast<int>(place));
    }
  }
  reorder_joints(order, layout);
  return offset;
}

void fill_blocks(Layout& layout) {
  if (!is_uneven(layout)) return;
  const std::size_t count = layout.walls.size() - std::ranges::count(layout.walls, true, &LayoutWall::rigid);
  std::map<int, std::vector<int>> waiting;  // by number of elements
  std::vector<int> order;
  order.reserve(layout.walls.size());
  const auto pass = [&order](std::vector<int>& walls) {
    order.insert(order.end(), walls.begin(), walls.end());
    walls.clear();
  };
  for (std::size_t wall = 0; wall < count; ++wall) {
    std::vector<int>& alike = waiting[layout.walls[wall].elements];
    alike.push_back(static_cast<int>(wall));
    if (alike.size() == kMostWallsInBlock) pass(alike);
    if (wall % kMostWait != 0) continue;
    for (auto& [elements, walls] : waiting) {
      if (!walls.empty() && static_cast<std::size_t>(walls.front()) + kMostWait <= wall) pass(walls);
    }
  }
  for (auto& [elements, walls] : waiting) pass(walls);
  for (std::size_t wall = count; wall < layout.walls.size(); ++wall) order.push_back(static_cast<int>(wall));
  reorder_walls(order, layout);
}

void list_added_joints(Layout& layout) {
  if (layout.order.joint.empty()) return;
  const std::size_t listed = layout.order.joint.size();
  layout.order.joint.resize(layout.joints.size());
  std::iota(layout.order.joint.begin() + static_cast<std::ptrdiff_t>(listed), layout.order.joint.end(),
            static_cast<int>(listed));
}

}  // namespace cellcrush

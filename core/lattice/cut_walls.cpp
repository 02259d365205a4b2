#include "lattice/cut_walls.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

#include "geometry/find_parts.h"

namespace cellcrush {
namespace {

constexpr double kOnOutline = 1e-9;     // of the diagonal of the outline
constexpr double kShortestWall = 1e-3;  // of the mean wall

/// What a cut leaves of a wall, and where its new ends lie.
class PolygonCutter {
 public:
  PolygonCutter(const Polygon& polygon, Layout& layout)
      : corners_(polygon), layout_(layout), box_(box_around(polygon)), on_edge_(polygon.size()) {
    near_ = kOnOutline * (box_.high - box_.low).norm();
  }

  /// The pieces of a wall inside, in order along it.
  std::vector<LayoutWall> pieces_of(const LayoutWall& wall) {
    const Vector2 from = layout_.joints[wall.start];
    const Vector2 to = layout_.joints[wall.end];
    if ((from.cwiseMax(to) - box_.low).minCoeff() < -near_ || (box_.high - from.cwiseMin(to)).minCoeff() < -near_) {
      return {};
    }
    const std::vector<Crossing> crossings = crossings_of(from, to);
    std::vector<LayoutWall> pieces;
    Crossing begin = crossings.front();
    bool is_open = false;
    for (std::size_t i = 0; i + 1 < crossings.size(); ++i) {
      const double middle = 0.5 * (crossings[i].share + crossings[i + 1].share);
      const bool inside = is_inside(from + middle * (to - from));
      if (inside && !is_open) begin = crossings[i];
      if (inside) is_open = true;
      if (is_open && (!inside || i + 2 == crossings.size())) {
        const Crossing& end = inside ? crossings[i + 1] : crossings[i];
        is_open = false;
        if ((end.share - begin.share) * (to - from).norm() <= near_) continue;  // it touches a corner
        LayoutWall& piece = pieces.emplace_back(wall);
        piece.start = joint_at(begin, wall, from, to);
        piece.end = joint_at(end, wall, from, to);
      }
    }
    return pieces;
  }

  /// Walls along the polygon, from one cut end or corner to the next.
  void add_edge_walls(double thickness) {
    if (std::ranges::all_of(on_edge_, [](const auto& ends) { return ends.empty(); })) return;
    std::vector<int> corner_joints;
    for (const Vector2& corner : corners_) {
      corner_joints.push_back(static_cast<int>(layout_.joints.size()));
      layout_.joints.push_back(corner);
    }
    for (std::size_t edge = 0; edge < corners_.size(); ++edge) {
      on_edge_[edge].emplace_back(0.0, corner_joints[edge]);
      on_edge_[edge].emplace_back(1.0, corner_joints[(edge + 1) % corners_.size()]);
      std::ranges::sort(on_edge_[edge]);
      for (std::size_t i = 0; i + 1 < on_edge_[edge].size(); ++i) {
        LayoutWall& added = layout_.walls.emplace_back();
        added.start = on_edge_[edge][i].second;
        added.end = on_edge_[edge][i + 1].second;
        added.thickness = thickness;
      }
    }
  }

 private:
  struct Crossing {
    double share = 0.0;  ///< along the wall
    int edge = -1;       ///< of the polygon
    double along = 0.0;  ///< a share of that edge
  };

  [[nodiscard]] Vector2 edge(std::size_t i) const { return corners_[(i + 1) % corners_.size()] - corners_[i]; }

  /// With both ends of the wall.
  [[nodiscard]] std::vector<Crossing> crossings_of(const Vector2& from, const Vector2& to) const {
    const Vector2 wall = to - from;
    const double round_off = near_ / wall.norm();
    std::vector<Crossing> crossings = {{0.0}, {1.0}};
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const double determinant = cross(wall, edge(i));
      if (determinant == 0.0) continue;
      const double share = cross(corners_[i] - from, edge(i)) / determinant;
      const double along = cross(corners_[i] - from, wall) / determinant;
      if (share < -round_off || share > 1.0 + round_off || along < -round_off || along > 1.0 + round_off) {
        continue;
      }
      const Crossing found = {std::clamp(share, 0.0, 1.0), static_cast<int>(i), along};
      if (share < round_off) {
        crossings.front() = {0.0, found.edge, along};
      } else if (share > 1.0 - round_off) {
        crossings[1] = {1.0, found.edge, along};
      } else {
        crossings.push_back(found);
      }
    }
    std::ranges::stable_sort(crossings, {}, &Crossing::share);
    return crossings;
  }

  [[nodiscard]] bool is_inside(const Vector2& place) const {
    bool inside = false;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Vector2& one = corners_[i];
      const Vector2& other = corners_[(i + 1) % corners_.size()];
      const double share = std::clamp((place - one).dot(edge(i)) / edge(i).squaredNorm(), 0.0, 1.0);
      if ((one + share * edge(i) - place).norm() <= near_) return true;
      const bool is_beside = (one.y() > place.y()) != (other.y() > place.y());
      if (is_beside && place.x() < one.x() + (place.y() - one.y()) / edge(i).y() * edge(i).x()) inside = !inside;
    }
    return inside;
  }

  /// The joint of an end of a wall, or a new one on the polygon.
  int joint_at(const Crossing& crossing, const LayoutWall& wall, const Vector2& from, const Vector2& to) {
    int joint = crossing.share == 0.0 ? wall.start : wall.end;
    if (crossing.share > 0.0 && crossing.share < 1.0) {
      joint = static_cast<int>(layout_.joints.size());
      Vector2 place = from + crossing.share * (to - from);
      const Vector2& corner = corners_[crossing.edge];
      for (const int axis : {0, 1}) {
        if (edge(crossing.edge)[axis] == 0.0) place[axis] = corner[axis];
      }
      layout_.joints.push_back(place);
    }
    if (crossing.edge >= 0) on_edge_[crossing.edge].emplace_back(crossing.along, joint);
    return joint;
  }

  const Polygon& corners_;
  Layout& layout_;
  Box box_;
  double near_ = 0.0;
  std::vector<std::vector<std::pair<double, int>>> on_edge_;  ///< share of the edge and joint
};

/// Makes both ends of a wall that is too short one joint. Of two walls that then have the same joints the first stays.
void merge_short_walls(double shortest, Layout& layout) {
  std::vector<LayoutWall> short_walls;
  std::ranges::copy_if(layout.walls, std::back_inserter(short_walls),
                       [&](const LayoutWall& wall) { return layout.chord_of(wall) < shortest; });
  const std::vector<int> joint = find_parts(layout.joints.size(), short_walls);
  std::set<std::pair<int, int>> seen;
  std::vector<char> is_kept;
  for (LayoutWall& wall : layout.walls) {
    wall.start = joint[wall.start];
    wall.end = joint[wall.end];
    is_kept.push_back(wall.start != wall.end && seen.insert(std::minmax(wall.start, wall.end)).second ? 1 : 0);
  }
  keep_walls(is_kept, layout);
}

/// Of the walls that had been one part, which `origin` tells, keeps the largest of the parts that they are now.
Islands leave_out_islands(const std::vector<int>& origin, Layout& layout) {
  const std::vector<int> part = find_parts(layout.joints.size(), layout.walls);
  std::map<std::pair<int, int>, int> walls;  // of an origin, of a part
  for (std::size_t w = 0; w < layout.walls.size(); ++w) {
    ++walls[{origin[w], part[layout.walls[w].start]}];
  }
  std::map<int, std::pair<int, int>> largest;  // of an origin: number of walls, part
  for (const auto& [key, count] : walls) {
    auto& best = largest[key.first];
    if (count > best.first) best = {count, key.second};
  }
  std::set<int> kept;
  for (const auto& [of_origin, best] : largest) kept.insert(best.second);
  Islands islands;
  std::set<int> left_out;
  std::vector<char> is_kept;
  for (const LayoutWall& wall : layout.walls) {
    is_kept.push_back(kept.contains(part[wall.start]) ? 1 : 0);
    if (is_kept.back() != 0) continue;
    left_out.insert(part[wall.start]);
    ++islands.walls;
  }
  islands.count = static_cast<int>(left_out.size());
  keep_walls(is_kept, layout);
  return islands;
}

}  // namespace

Box box_around(const std::vector<Vector2>& places) {
  Box box = {places.front(), places.front()};
  for (const Vector2& place : places) {
    box.low = box.low.cwiseMin(place);
    box.high = box.high.cwiseMax(place);
  }
  return box;
}

Polygon rectangle_between(const Vector2& corner, const Vector2& opposite) {
  const Vector2 low = corner.cwiseMin(opposite);
  const Vector2 high = corner.cwiseMax(opposite);
  return {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
}

void keep_walls(const std::vector<char>& is_kept, Layout& layout) {
  std::vector<char> is_used(layout.joints.size(), 0);
  std::vector<LayoutWall> walls;
  for (std::size_t w = 0; w < layout.walls.size(); ++w) {
    if (is_kept[w] == 0) continue;
    walls.push_back(layout.walls[w]);
    is_used[walls.back().start] = is_used[walls.back().end] = 1;
  }
  std::vector<int> number(layout.joints.size(), 0);
  std::vector<Vector2> joints;
  for (std::size_t joint = 0; joint < layout.joints.size(); ++joint) {
    number[joint] = static_cast<int>(joints.size());
    if (is_used[joint] != 0) joints.push_back(layout.joints[joint]);
  }
  for (LayoutWall& wall : walls) {
    wall.start = number[wall.start];
    wall.end = number[wall.end];
  }
  layout.joints = std::move(joints);
  layout.walls = std::move(walls);
}

Islands cut_at(const Polygon& polygon, double edge_wall_thickness, Layout& layout) {
  if (layout.walls.empty()) return {};
  double mean = 0.0;
  for (const LayoutWall& wall : layout.walls) mean += layout.chord_of(wall) / static_cast<double>(layout.walls.size());
  const std::vector<LayoutWall> given = std::move(layout.walls);
  const std::vector<int> part = find_parts(layout.joints.size(), given);
  layout.walls.clear();
  PolygonCutter cutter(polygon, layout);
  std::vector<int> origin;  // of each piece, the part of its wall
  for (const LayoutWall& wall : given) {
    for (const LayoutWall& piece : cutter.pieces_of(wall)) {
      layout.walls.push_back(piece);
      origin.push_back(part[wall.start]);
    }
  }
  if (edge_wall_thickness > 0.0) cutter.add_edge_walls(edge_wall_thickness);
  origin.resize(layout.walls.size(), part[given.front().start]);
  const Islands islands = leave_out_islands(origin, layout);
  merge_short_walls(kShortestWall * mean, layout);
  return islands;
}

}  // namespace cellcrush

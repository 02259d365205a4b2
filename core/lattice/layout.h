#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include "cellcrush/scene_spec.h"
#include "cellcrush/vector.h"
#include "cellcrush/walls.h"

namespace cellcrush {

/// A wall between two joints.
struct LayoutWall {
  int start = 0;
  int end = 0;
  double thickness = 0.0;  ///< mm
  int elements = 1;        ///< number of elements into which it is divided
  int material = 0;        ///< index into Scene::materials
  bool rigid = false;      ///< part of a rigid body: straight and not divided
  double bow = 0.0;        ///< offset of its middle from its undisturbed line, to the left of start to end, mm
  double rise = 0.0;       ///< of a circular arc over the line from start to end, to its left, mm; 0: straight
};

/// The rectangle around points, mm.
struct Bounds {
  Vector2 low = Vector2::Zero();
  Vector2 high = Vector2::Zero();
};
Bounds bounds_of(const std::vector<Vector2>& points);

/// Joints and walls of a structure before it is divided into elements. Lengths in mm.
struct Layout {
  std::vector<Vector2> joints;
  std::vector<LayoutWall> walls;
  Bounds envelope;  ///< of the joints before any imperfection; filled in by the mesh
  /// Joints at the low side of a period and their images at the high side (lattice/period.h).
  std::vector<std::pair<int, int>> images;
  ListOrder order;  ///< of joints and walls, as laid out at first

  [[nodiscard]] std::size_t element_count() const {
    const auto add = [](std::size_t sum, const LayoutWall& wall) { return sum + wall.elements; };
    return std::accumulate(walls.begin(), walls.end(), std::size_t{0}, add);
  }
  [[nodiscard]] double chord_of(const LayoutWall& wall) const { return (joints[wall.end] - joints[wall.start]).norm(); }
};

/// The items of a list in the order given by their present numbers.
template <class Item>
std::vector<Item> reordered(const std::vector<Item>& items, const std::vector<int>& order) {
  std::vector<Item> result;
  result.reserve(items.size());
  for (const int from : order) result.push_back(items[from]);
  return result;
}

/// Where each item is in that order.
std::vector<int> places_of(const std::vector<int>& order);

/// Divides every wall that is not rigid in proportion to its length: one of mean length into this many elements, each
/// into at least one. Elements are then of about one length, and no short one sets the step.
void divide_walls(int elements_of_mean, Layout& layout);

/// Extent of the joints in x and y, mm.
Vector2 envelope_of(const std::vector<Vector2>& joints);

/// Moves every joint by a uniformly distributed offset of at most the amplitude of the imperfection in x and in y, and
/// at most an eighth of the shortest wall at the joint. The same seed gives the same offsets on every machine.
void perturb(const Imperfection& imperfection, Layout& layout);

/// Bows every wall, by a uniformly distributed offset of its middle of at most the bow of the imperfection, to either
/// side. The offsets do not depend on those of the joints.
void bow(const Imperfection& imperfection, std::vector<LayoutWall>& walls);

/// Numbers the joints column by column, and the walls in the order of their joints. Columns run across x in a large
/// lattice that is longer along x than along y and has neither rigid walls nor images: bands (contact/topology/bands.h)
/// then run across it and are small. They run across the crush in a lattice whose walls differ in their numbers of
/// elements: walls of a block are then crushed together, and a kernel that finds no yielding wall does less. Other
/// lattices stay as they are. `places` are the positions of the joints before any imperfection, mm.
void number_columns(const std::vector<Vector2>& places, int crush_axis, Layout& layout);

/// Numbers the joints of rigid walls first, with those of the same body side by side, and moves rigid walls to the end.
/// Returns RigidBodies::offset.
std::vector<int> put_rigid_bodies_first(Layout& layout);

/// Puts walls with the same number of elements together, so that they fill blocks (WallBlock), which are computed in
/// vectors: the walls of other blocks take several times as long. A wall waits for a block to be filled while others
/// pass it, but not for long: joints would leave the cache. Where all walls have the same number they stay as they are.
void fill_blocks(Layout& layout);

/// Numbers joints that have been added behind those that are listed, where the order is not that of the list.
void list_added_joints(Layout& layout);

using GridPoint = Eigen::Vector2i;

/// The points from (0, 0) to `last`, inclusive; some of them are joints.
struct JointGrid {
  GridPoint last;
  std::function<Vector2(const GridPoint& point)> place;  ///< mm
};

/// A grid of points that are `spacing` apart, mm.
inline JointGrid even_grid(const GridPoint& last, const Vector2& spacing) {
  return {last, [spacing](const GridPoint& point) -> Vector2 { return spacing.cwiseProduct(point.cast<double>()); }};
}

/// Collects the walls of a lattice whose joints are points of a grid.
class WallBuilder {
 public:
  explicit WallBuilder(const JointGrid& grid) : grid_(grid), joint_at_(grid.last), wall_at_(2 * grid.last) {}

  /// Adds a wall. Of a wall that two cells share, the greater thickness holds, and it is rigid if one of them is. It
  /// leads from where it did first.
  LayoutWall& add_wall(const GridPoint& from, const GridPoint& to, double thickness, bool rigid = false) {
    int& number = wall_at_[from + to];  // twice the mid-point, at which there is no other wall
    if (number == Numbers::kNone) {
      number = static_cast<int>(layout_.walls.size());
      layout_.walls.push_back({joint(from), joint(to), thickness});
    }
    LayoutWall& wall = layout_.walls[number];
    wall.thickness = std::max(wall.thickness, thickness);
    wall.rigid = wall.rigid || rigid;
    return wall;
  }

  Layout take() { return std::move(layout_); }

 private:
  /// A number for each point from (0, 0) to `last`, inclusive.
  class Numbers {
   public:
    static constexpr int kNone = -1;

    explicit Numbers(const GridPoint& last)
        : columns_(last.x() + 1), number_(static_cast<std::size_t>(columns_) * (last.y() + 1), kNone) {}

    int& operator[](const GridPoint& point) {
      return number_[static_cast<std::size_t>(point.y()) * columns_ + point.x()];
    }

   private:
    int columns_;
    std::vector<int> number_;
  };

  int joint(const GridPoint& point) {
    int& number = joint_at_[point];
    if (number == Numbers::kNone) {
      number = static_cast<int>(layout_.joints.size());
      layout_.joints.push_back(grid_.place(point));
    }
    return number;
  }

  JointGrid grid_;
  Numbers joint_at_;
  Numbers wall_at_;
  Layout layout_;
};

}  // namespace cellcrush

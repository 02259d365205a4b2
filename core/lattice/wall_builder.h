#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "lattice/layout.h"

namespace cellcrush {

using GridPoint = Eigen::Vector2i;

/// The points from (0, 0) to `last`, inclusive; some of them are joints.
struct JointGrid {
  GridPoint last;
  Vector2 spacing;  ///< mm

  [[nodiscard]] Vector2 envelope() const { return spacing.cwiseProduct(last.cast<double>()); }
};

/// Collects the walls of a lattice whose joints are points of a grid.
class WallBuilder {
 public:
  WallBuilder(const JointGrid& grid, int elements)
      : grid_(grid), joint_at_(grid.last), wall_at_(2 * grid.last), elements_(elements) {}

  /// Adds a wall. Of a wall that two cells share, the greater thickness holds, and it is rigid if one of them is.
  void add_wall(const GridPoint& from, const GridPoint& to, double thickness, bool rigid = false) {
    int& number = wall_at_[from + to];  // twice the mid-point, at which there is no other wall
    if (number == Numbers::kNone) {
      number = static_cast<int>(layout_.walls.size());
      layout_.walls.push_back({joint(from), joint(to), thickness, elements_});
    }
    LayoutWall& wall = layout_.walls[number];
    wall.thickness = std::max(wall.thickness, thickness);
    wall.rigid = wall.rigid || rigid;
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
      layout_.joints.emplace_back(grid_.spacing.cwiseProduct(point.cast<double>()));
    }
    return number;
  }

  JointGrid grid_;
  Numbers joint_at_;
  Numbers wall_at_;
  int elements_;
  Layout layout_;
};

}  // namespace cellcrush

#pragma once

#include <cstdint>
#include <unordered_map>
#include <utility>

#include "cellcrush/vector.h"
#include "scene/mesh.h"

namespace cellcrush {

/// Collects the walls of a regular lattice whose joints have whole coordinates on some grid; a joint or wall that several
/// cells share is made once. Joints are numbered in the order in which they are first named.
class LayoutBuilder {
 public:
  using GridPoint = std::pair<int, int>;

  /// `unit` is the grid's spacing in x and in y, mm.
  LayoutBuilder(const Vector2& unit, int elements_per_wall);

  /// Adds a wall, or makes an existing one as thick as `thickness` (mm) when it is thinner, and rigid when `rigid`.
  void add_wall(GridPoint from, GridPoint to, double thickness, bool rigid = false);

  Layout take() { return std::move(layout_); }

 private:
  int joint(GridPoint point);

  Vector2 unit_;
  int elements_per_wall_;
  Layout layout_;
  std::unordered_map<std::uint64_t, int> joints_;         ///< by the bits of their grid points
  std::unordered_map<std::uint64_t, std::size_t> walls_;  ///< by those of their joints, the lower one first
};

}  // namespace cellcrush

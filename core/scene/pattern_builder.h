#pragma once

#include <array>
#include <utility>
#include <vector>

#include "scene/lattice_pattern.h"

namespace cellcrush {

/// Collects the walls of a regular lattice; a joint or wall that several cells share is created once. Joints are
/// numbered in the order of their first use.
class PatternBuilder {
 public:
  using GridPoint = LatticePattern::GridPoint;

  /// For a lattice in the grid from (0, 0) to `last`, inclusive.
  explicit PatternBuilder(GridPoint last);

  /// Adds a wall, or makes an existing one stiff if `kind` is.
  void add_wall(GridPoint from, GridPoint to, int kind);

  LatticePattern take() { return std::move(pattern_); }

 private:
  /// Walls that end at a joint, with the joint at their other end.
  struct Neighbours {
    static constexpr int kMost = 6;
    int count = 0;
    std::array<int, kMost> joint;
    std::array<int, kMost> wall;
  };

  int joint(GridPoint point);
  [[nodiscard]] int find_wall(int start, int end) const;  ///< -1: none

  LatticePattern pattern_;
  int columns_;                         ///< number of columns of grid points
  std::vector<int> joints_;             ///< joint of each grid point; -1: none
  std::vector<Neighbours> neighbours_;  ///< of each joint
};

}  // namespace cellcrush

#pragma once

#include <array>
#include <utility>
#include <vector>

#include "scene/lattice_pattern.h"

namespace cellcrush {

/// Collects the walls of a regular lattice; a joint or wall that several cells share is made once. Joints are numbered
/// in the order in which they are first named.
class PatternBuilder {
 public:
  using GridPoint = LatticePattern::GridPoint;

  /// Of a lattice in the grid from (0, 0) to `last`, both with it.
  explicit PatternBuilder(GridPoint last);

  /// Adds a wall, or makes an existing one stiff when `kind` is.
  void add_wall(GridPoint from, GridPoint to, int kind);

  LatticePattern take() { return std::move(pattern_); }

 private:
  /// Walls that end at a joint, by the joint at their other end.
  struct Neighbours {
    static constexpr int kMost = 6;
    int count = 0;
    std::array<int, kMost> joint;
    std::array<int, kMost> wall;
  };

  int joint(GridPoint point);
  [[nodiscard]] int find_wall(int start, int end) const;  ///< -1: there is none

  LatticePattern pattern_;
  int columns_;                         ///< of grid points
  std::vector<int> joints_;             ///< of each grid point; -1: none
  std::vector<Neighbours> neighbours_;  ///< of each joint
};

}  // namespace cellcrush

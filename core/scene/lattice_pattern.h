#pragma once

#include <array>
#include <utility>
#include <vector>

namespace cellcrush {

/// Kinds of walls of a regular lattice, by which they have their thickness: sums of these.
inline constexpr int kUprightWall = 1;  ///< along y, of hexagons
inline constexpr int kStiffWall = 2;    ///< of a cell in a row of inclusions
inline constexpr int kWallKinds = 4;

/// A value for each kind of wall.
using ByWallKind = std::array<double, kWallKinds>;

/// Joints and walls of a regular lattice in the whole numbers of its grid: what its sizes do not change.
struct LatticePattern {
  using GridPoint = std::pair<int, int>;
  struct Wall {
    int start = 0;  ///< into joints
    int end = 0;
    int kind = 0;
  };
  std::vector<GridPoint> joints;
  std::vector<Wall> walls;
};

}  // namespace cellcrush

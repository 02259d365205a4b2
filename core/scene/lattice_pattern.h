#pragma once

#include <array>
#include <utility>
#include <vector>

namespace cellcrush {

/// Kinds of walls of a regular lattice, which determine the thickness; kinds are sums of these bits.
inline constexpr int kUprightWall = 1;  ///< along y, of hexagons
inline constexpr int kStiffWall = 2;    ///< of a cell in a row of inclusions
inline constexpr int kWallKinds = 4;

/// A value for each kind of wall.
using ByWallKind = std::array<double, kWallKinds>;

/// Joints and walls of a regular lattice in integer coordinates of its grid: the part that does not depend on its
/// sizes.
struct LatticePattern {
  using GridPoint = std::pair<int, int>;
  struct Wall {
    int start = 0;  ///< index into joints
    int end = 0;
    int kind = 0;
  };
  std::vector<GridPoint> joints;
  std::vector<Wall> walls;
};

}  // namespace cellcrush

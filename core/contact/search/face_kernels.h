#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "cellcrush/state.h"

// What the search by faces computes for several particles side by side.

namespace cellcrush {

/// Bounding box of velocities, mm/s; v_low and v_high of E8c.
struct VelocityBox {
  Vector2 low;
  Vector2 high;
};

/// Bounding box of the velocities of some particles. REQUIRES: at least one member.
VelocityBox box_of_velocities(const State& state, std::span<const int> members);

/// Number of corners from which the particles of a face are sorted into buckets.
inline constexpr int kManyCorners = 64;

/// Points whose distances from a segment are computed side by side.
inline constexpr std::size_t kPointTile = 8;

/// The number of points after the last tile is filled up.
constexpr std::size_t filled_tiles(std::size_t points) { return (points + kPointTile - 1) / kPointTile * kPointTile; }

/// A segment of a face, mm.
struct FaceSegment {
  Vector2 start;
  Vector2 axis;
  double length;
};

/// Distances of the corners of a face from one of its segments.
struct NearCorners {
  std::uint64_t near = 0;                             ///< bits of the corners within range
  double least_of_others = 0.0;                       ///< mm^2, least squared distance of the others
  std::array<double, kManyCorners> squared_distance;  ///< mm^2
};

/// Finds the squared distances of `count` corners from a segment (see project), and the corners within range. Whole
/// tiles round like single points, to the same bits. REQUIRES: whole tiles of positions, at most kManyCorners; those
/// after the corners repeat the last one.
void find_near_corners(std::span<const Vector2> places, std::size_t count, const FaceSegment& segment,
                       double squared_range, NearCorners& found);

}  // namespace cellcrush

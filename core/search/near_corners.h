#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "cellcrush/vector.h"

namespace cellcrush {

/// Corners from which on a face's particles are sorted into buckets.
inline constexpr int kManyCorners = 64;

/// Points whose distances from a segment are found together.
inline constexpr std::size_t kPointTile = 8;

/// So many points with others that fill the last tile up.
constexpr std::size_t filled_tiles(std::size_t points) { return (points + kPointTile - 1) / kPointTile * kPointTile; }

/// A segment of a face, mm.
struct FaceSegment {
  Vector2 start;
  Vector2 axis;
  double length;
};

/// How the corners of a face lie to one of its segments.
struct NearCorners {
  std::uint64_t near = 0;                             ///< bits of those within range
  double least_of_others = 0.0;                       ///< mm^2
  std::array<double, kManyCorners> squared_distance;  ///< mm^2
};

/// Finds the squared distances of corners from a segment (see project) and those within range; only corners whose bits
/// are set count as near or as others. Whole tiles round as single points do: the same bits. REQUIRES: whole tiles of
/// places, at most kManyCorners.
void find_near_corners(std::span<const Vector2> places, std::uint64_t corners, const FaceSegment& segment,
                       double squared_range, NearCorners& found);

}  // namespace cellcrush

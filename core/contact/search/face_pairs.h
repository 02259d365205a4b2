#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/search/candidate_lists.h"

namespace cellcrush {

// What the search by faces computes for several particles side by side.

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

/// What lies near each other in a face.
struct FacePairs {
  std::vector<Candidate> candidates;  ///< closer than touch and skin; of pairs that two faces share, those of this face
  double least_gap = 0.0;  ///< mm that all other pairs of the face are apart beyond touch, at least; over the skin
  bool crossed = false;    ///< walls of the face have crossed, or it is turned inside out
};

/// Holds the balls of a face against its segments, all of them or, in faces of many corners, those in the same buckets.
/// A pair that two faces have (along the wall between them, or at a thick end) is listed with the face of the lower
/// number. Of the outer face, pairs of balls of other bands are left out. REQUIRES: finite positions, axes and lengths
/// of these positions.
FacePairs find_face_pairs(const Scene& scene, const State& state, const LatticeBand& band, const FacesOfBand& faces,
                          int face, double skin);

/// Whether a face's pairs are found over a grid. A face without all its corners has no order to go by.
inline bool has_many_corners(const FacesOfBand& faces, int face) {
  return faces.corner_count(face) >= kManyCorners || (!faces.is_outer_whole && face == faces.count() - 1);
}

}  // namespace cellcrush

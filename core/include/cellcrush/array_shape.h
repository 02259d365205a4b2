#pragma once

namespace cellcrush {

/// What an array has an entry for; arrays of offsets have one entry more, of the end.
enum class Per {
  few,  ///< a single number, or as many as the case lists one by one: loads, motions, watched nodes
  particle,
  joint,
  element,
  fibre,
  section,
  wall,
  wall_block,
  wall_chunk,
  moved_chunk,  ///< of particles (motion/integrate_motion.h)
  band,
  border_particle,
  rigid_body,
  limited_pair,
  cell,
  thick_end,
  face,    ///< by which contacts are searched, as the next three
  corner,  ///< or thick end of a face
  face_group,
  group_member,
  candidate,  ///< places for candidates, from here on: these arrays grow over a crush
  candidate_batch,
  touch,
  candidate_of_band,  ///< of the band whose contacts are evaluated
  touch_of_band
};
inline constexpr int kPerCount = static_cast<int>(Per::touch_of_band) + 1;

/// What a run must have for an array not to be empty; flags that are combined.
enum Needs : unsigned {
  kAlways = 0,
  kHardening = 1U << 0,
  kNoHardening = 1U << 1,
  kForceBased = 1U << 2,
  kSingleFibres = 1U << 3,
  kDoubleFibres = 1U << 4,
  kContact = 1U << 5,
  kFriction = 1U << 6,       ///< of walls or plates
  kWallFriction = 1U << 7,   ///< of walls
  kPlateFriction = 1U << 8,  ///< of plates
  kFaces = 1U << 9,          ///< contacts are searched by faces
  kBuckets = 1U << 10,       ///< contacts are searched by buckets
  kPlates = 1U << 11,
  kLoads = 1U << 12,
  kSupports = 1U << 13,
  kInitialMotion = 1U << 14
};

/// How many entries an array has.
struct Shape {
  Per per;
  unsigned needs;  ///< of Needs, all of them
  int times;       ///< entries for each

  // NOLINTNEXTLINE(google-explicit-constructor): most shapes are no more than that.
  constexpr Shape(Per of, unsigned needed = kAlways, int entries = 1) : per(of), needs(needed), times(entries) {}
};

}  // namespace cellcrush

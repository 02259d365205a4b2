#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/candidate_lists.h"
#include "contact/near_corners.h"

namespace cellcrush {

/// What lies near each other in a face.
struct FacePairs {
  std::vector<Candidate> candidates;  ///< closer than touch and skin; of pairs that two faces share, those of this face
  double least_gap = 0.0;  ///< mm that all other pairs of the face are apart beyond touch, at least; over the skin
  bool crossed = false;    ///< walls of the face have crossed, or it is turned inside out
};

/// Holds the balls of a face against its segments, all of them or, in faces of many corners, those in the same buckets.
/// Of a pair that borders two faces alike (along a wall between them) the face with the lower number has it.
/// REQUIRES: finite positions, axes and lengths of these positions.
FacePairs find_face_pairs(const Scene& scene, const State& state, int face, double skin);

}  // namespace cellcrush

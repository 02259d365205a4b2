#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/search/candidate_lists.h"
#include "contact/search/face_kernels.h"

namespace cellcrush {

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

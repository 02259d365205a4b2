#pragma once

#include <cstddef>
#include <vector>

#include "cellcrush/scene.h"

namespace cellcrush {

/// Most candidate positions, per particle or element, that find_initial_overlaps visits before it gives up.
inline constexpr double kMostOverlapVisits = 512.0;
/// Number of segments near each ball at which it gives up.
inline constexpr double kMostNearSegments = 100.0;

/// Two elements whose walls overlap before loading.
struct InitialOverlap {
  int first = 0;
  int second = 0;
  Vector2 place;  ///< mm
};

struct InitialOverlaps {
  std::vector<InitialOverlap> found;  ///< at most as many as requested, each pair once
  /// Given up: walls so thick or tangled that the run's list of candidates would not end either.
  bool too_dense = false;
};

/// Where contacts would push before anything has moved: balls that touch a segment by the rule of the run (E8, E8a),
/// and elements that cross without a common node, far from any ball. Time and memory grow in proportion to the number
/// of elements. REQUIRES: a mesh with radii and incidence.
InitialOverlaps find_initial_overlaps(const Scene& scene, std::size_t most);

}  // namespace cellcrush

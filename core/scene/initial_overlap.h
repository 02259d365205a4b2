#pragma once

#include <cstddef>
#include <vector>

#include "cellcrush/scene.h"

namespace cellcrush {

/// Places that find_initial_overlaps looks at before it gives up, for each particle or element.
inline constexpr double kMostOverlapVisits = 512.0;
/// Segments near each ball with which it gives up.
inline constexpr double kMostNearSegments = 100.0;

/// Two elements whose walls lie in each other before loading.
struct InitialOverlap {
  int first = 0;
  int second = 0;
  Vector2 place;  ///< mm
};

struct InitialOverlaps {
  std::vector<InitialOverlap> found;  ///< at most as many as asked for, each pair once
  bool too_dense =
      false;  ///< given up: walls so thick or tangled that the run's list of candidates would not end either
};

/// Where contacts would push before anything has moved: balls that touch a segment by the rule of the run, and elements
/// that cross without a common node, far from any ball. Time and memory grow as the number of elements. REQUIRES: a
/// mesh with radii and incidence.
InitialOverlaps find_initial_overlaps(const Scene& scene, std::size_t most);

}  // namespace cellcrush

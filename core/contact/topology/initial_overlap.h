#pragma once

#include <cstddef>
#include <vector>

#include "cellcrush/scene.h"

namespace cellcrush {

/// Most candidate positions, per particle or element, that find_initial_overlaps visits before it gives up.
inline constexpr double kMostOverlapVisits = 512.0;
/// Number of segments near each ball at which it gives up.
inline constexpr double kMostNearSegments = 100.0;

/// Two elements whose mid-lines cross or touch before loading without a common node.
struct InitialCrossing {
  int first = 0;
  int second = 0;
  Vector2 place;  ///< mm
};

struct InitialOverlaps {
  /// At most as many as requested, each pair once. Neither side of a wall is that of a ball on its mid-line, so that
  /// contact cannot keep them apart.
  std::vector<InitialCrossing> crossings;
  /// Balls that touch a wall by the rule of the run (E8, E8a), with the reach that they have until they have parted.
  StartOverlaps touching;
  /// Given up: walls so thick or tangled that the run's list of candidates would not end either.
  bool too_dense = false;
};

/// Where contacts would push before anything has moved, and elements that cross without a common node, far from any
/// ball. Time and memory grow in proportion to the number of elements. REQUIRES: a mesh with radii and incidence.
InitialOverlaps find_initial_overlaps(const Scene& scene, std::size_t most_crossings);

}  // namespace cellcrush

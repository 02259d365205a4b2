#pragma once

#include <algorithm>
#include <cmath>

#include "cellcrush/vector.h"

namespace cellcrush {

/// Where a point projects onto a segment, the ends included: a segment with its thickness is a capsule.
///
/// Deviation from Eq. 41a, 42: the projection is clamped to the segment, so that a ball that slides off its end at a convex
/// joint meets the round end instead of a gap, and the distance is the length of the offset.
struct Projection {
  double along;    ///< mm from the start, 0 to length
  Vector2 offset;  ///< from the foot to the point
};

inline Projection project(const Vector2& point, const Vector2& start, const Vector2& axis, double length) {
  const Vector2 from_start = point - start;
  const double ahead = from_start.dot(axis);
  // max(ahead, 0) in a form that compiles without a branch: feet lie on either side of the ends too often to be guessed.
  const double along = std::min(0.5 * (ahead + std::abs(ahead)), length);
  return {along, from_start - along * axis};
}

}  // namespace cellcrush

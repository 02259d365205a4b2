#pragma once

#include "cellcrush/vector.h"

namespace cellcrush {

/// The projection of a point onto a segment, ends included: a segment with its thickness is a capsule (E8).
///
/// Deviation from Eq. 41a, 42: the projection is clamped to the segment. A ball that slides off its end at a convex
/// joint meets the round end instead of a gap. The distance is the length of the offset.
struct Projection {
  double along;    ///< mm from the start, 0 to length
  Vector2 offset;  ///< from the foot of the perpendicular to the point
};

/// `axis`: unit vector along the segment; `length` in mm (geometry/capsule-inl.h).
Projection project(const Vector2& point, const Vector2& start, const Vector2& axis, double length);

}  // namespace cellcrush

#pragma once

#include <algorithm>
#include <span>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
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

/// `axis`: unit vector along the segment; `length` in mm.
Projection project(const Vector2& point, const Vector2& start, const Vector2& axis, double length);

/// The two parts of a penalty force along the normal of a contact, N (E8); their sum is never negative.
struct NormalForce {
  double elastic;  ///< k D
  double viscous;  ///< c dD/dt, at least -k D
};

/// Deviation from Eq. 43: the sum is clamped at 0, as a contact does not pull (E8).
constexpr NormalForce without_pull(double elastic, double viscous) { return {elastic, std::max(viscous, -elastic)}; }

/// Penalty force of a contact of depth D > 0 (mm) that deepens at `rate` (mm/s) (Eq. 43, E8). k and c include the
/// contact area (E9, contact/touch_geometry-inl.h).
NormalForce evaluate_normal_force(double stiffness, double damping_ratio, double inverse_mass, double depth,
                                  double rate);

/// Bilinear Coulomb friction (Eq. 44-47, E9b). The force of the step before, minus k times the slip of this step, is
/// clamped to `limit`, the friction coefficient times the normal force. N; `slip` in mm, in the direction that the
/// force opposes.
constexpr double evaluate_friction(double previous, double stiffness, double slip, double limit) {
  return std::clamp(previous - stiffness * slip, -limit, limit);
}

}  // namespace cellcrush

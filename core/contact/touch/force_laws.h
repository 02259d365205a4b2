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
inline double evaluate_friction(double previous, double stiffness, double slip, double limit) {
  return std::clamp(previous - stiffness * slip, -limit, limit);
}

// Friction acts where surfaces meet, at a distance from the mid-lines (E9d). The side of a segment turns with it. The
// round surface of a ball turns with the elements that end there, by the mean of their turning weighted by length.
// Nodes inside pairs have no rotation (E5b), so a couple on a surface acts as forces across its elements. These are
// conjugate to the turning: their work is that of the couple, and they have its moment.

/// One of the two surfaces of a contact, or the one at a plate.
struct RubbedSurface {
  std::span<const int> elements;  ///< with which it turns
  double arm;                     ///< mm, from the mid-line to the point of contact
};

/// The elements at a particle: those with which its ball turns.
inline std::span<const int> elements_at(const Scene& scene, int particle) {
  const int first = scene.incidence_offset[particle];
  return {scene.incidence.data() + first, scene.incidence.data() + scene.incidence_offset[particle + 1]};
}

/// Speed of a surface against its mid-line, mm/s, as it turns counter-clockwise.
double speed_by_turning(const Scene& scene, const State& state, const RubbedSurface& surface);

/// Adds the couple of a friction force (N), counter-clockwise, to friction_force. It is the transpose of
/// speed_by_turning: the work of these forces is that of the friction force over the way of the surface.
void add_couple(const Scene& scene, State& state, const RubbedSurface& surface, double force);

/// What the stiffness of friction is divided by on a surface, together with the other: above 1 only where elements are
/// shorter than 1.4 arms. There the couple's forces are greater than friction itself, and would make its spring stiffer
/// than that of the normal force.
double stiffening(const State& state, const RubbedSurface& surface);

}  // namespace cellcrush

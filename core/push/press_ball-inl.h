// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_PUSH_PRESS_BALL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_PUSH_PRESS_BALL_INL_H_
#undef CELLCRUSH_PUSH_PRESS_BALL_INL_H_
#else
#define CELLCRUSH_PUSH_PRESS_BALL_INL_H_
#endif

#include <algorithm>

#include "contact/contact_tiles.h"
#include "contact/growth_forces-inl.h"
#include "contact/touch/force_laws.h"
#include "contact/touch/rubbed_surface-inl.h"
#include "contact/touch_geometry-inl.h"
#include "push/push.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// The force of a face on a ball that overlaps it by `depth`, mm, if that is above 0 (E9c); see push_by_face.
template <class S>
HWY_INLINE FaceForce press_ball(const Scene& scene, S& state, const Face& face, int particle, double depth,
                                double inverse_mass) {
  if (!(depth > 0.0)) {
    return {};
  }
  const double rate = face.speed - face.normal.dot(state.velocity[particle]);
  const NormalForce force = without_pull(
      face.stiffness * depth, viscous_force(face.stiffness, scene.contact.damping_ratio, inverse_mass, rate));
  if (face.grows && state.radius_growth[particle] > 0.0) {
    push_elements_apart(scene, state, particle, force.elastic);
  }
  state.contact_force[particle].elastic += force.elastic * face.normal;
  state.contact_force[particle].viscous += force.viscous * face.normal;
  mark_contact_tile(state, particle);
  return {force.elastic, force.viscous, 0.0, 0.5 * force.elastic * depth};
}

/// Friction on a particle whose centre is `distance` mm from the face, at most `limit` N.
template <class S>
HWY_INLINE double rub(const Scene& scene, S& state, const Face& face, int particle, double distance, double limit) {
  const double side = cross(face.tangent, face.normal);  // of a turn that moves the ball's surface along the tangent
  const RubbedSurface surface = {elements_at(scene, particle), distance};
  const double speed = face.tangent.dot(state.velocity[particle]) + side * speed_by_turning(scene, state, surface);
  const double stiffness = face.stiffness / std::max(1.0, stiffening(state, surface));
  double& friction = face.friction_of[particle];
  friction = evaluate_friction(friction, stiffness, scene.schedule.time_step * speed, limit);
  state.friction_force[particle] += friction * face.tangent;
  add_couple(scene, state, surface, side * friction);
  return friction;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_PUSH_PRESS_BALL_INL_H_

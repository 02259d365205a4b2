// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_CONTACT_TOUCH_FRICTION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_CONTACT_TOUCH_FRICTION_INL_H_
#undef CELLCRUSH_CONTACT_TOUCH_FRICTION_INL_H_
#else
#define CELLCRUSH_CONTACT_TOUCH_FRICTION_INL_H_
#endif

#include <algorithm>
#include <cmath>
#include <span>

#include "contact/contact_workspace.h"
#include "contact/thickening.h"
#include "contact/touch/force_laws.h"
#include "contact/touch/rubbed_surface-inl.h"
#include "contact/touch_geometry-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// The pairs that touched in the step before, for the transfer of friction. A class that is one has:
///
///   range_of(ball)   those of a ball
///   segment(i)       of pair i
///   pushed(i)        TouchMemory::pushed
///   friction(i)      TouchMemory::friction
///   has_friction(i)  whether the pair still has friction in this step
///
/// Transfer of friction from one contact to the next.
template <class Before>
struct FrictionTransfer {
  const Scene& scene;
  const TouchMemory& touching;
  const Touches& touches;
  const Before& before;

  /// Friction, along the polyline, of a touch of the ball in the step before that has no friction now and whose element
  /// satisfies `follows`.
  template <class Follows>
  [[nodiscard]] HWY_INLINE double ended_friction(int ball, const Follows& follows) const {
    const PairRange range = before.range_of(ball);
    for (int earlier = range.first; earlier < range.end; ++earlier) {
      if (before.pushed(earlier) != 0 && !before.has_friction(earlier) &&
          follows(scene.elements[before.segment(earlier)])) {
        return before.friction(earlier) * before.pushed(earlier);
      }
    }
    return 0.0;
  }

  /// Friction with which a touch begins the step: its own, or that of a touch which it follows. A ball that slides to a
  /// neighbouring segment keeps its friction. Of two balls that touch, one hands it over to the other. Friction is
  /// measured along the polyline, in one direction on its left and in the other on its right.
  [[nodiscard]] HWY_INLINE double initial_friction(const ActiveContact& contact) const {
    const int ball = touching.ball[contact.touch];
    const int side = touching.side[contact.touch];
    const int known = touches.known[contact.touch];
    if (known != Touches::kNew && before.pushed(known) != 0) {
      return before.friction(known) * before.pushed(known) * side;
    }
    const Element& own = scene.elements[touching.segment[contact.touch]];
    const double of_neighbour =
        ended_friction(ball, [&](const Element& other) HWY_ATTR { return share_a_node(other, own); });
    if (of_neighbour != 0.0 || contact.node_touch == ActiveContact::kNone) {
      return of_neighbour * side;
    }
    return side * ended_friction(touches.node[contact.node_touch], [&](const Element& other) HWY_ATTR {
             return other.start == ball || other.end == ball;
           });
  }
};

/// The surfaces of a touch. The point of contact divides the distance of the mid-lines as R and h/2 do, so that the
/// arms sum to that distance and angular momentum is kept. At its ends a segment turns as the balls there.
struct RubbedPair {
  RubbedSurface ball;
  RubbedSurface segment;

  HWY_INLINE RubbedPair(const Scene& scene, const State& state, const TouchMemory& touching, const Touches& touches,
                        int touch) {
    const double share = touches.share[touch];
    const Element& element = scene.elements[touching.segment[touch]];
    const double radius = radius_now(scene, state, touching.ball[touch]);
    const double half_thickness =
        0.5 * element.thickness +
        std::lerp(growth_of_ball(state, element.start), growth_of_ball(state, element.end), share_of_end(share));
    const double deflection = scene.contact.bends ? touches.deflection[touch] : 0.0;
    const double distance = touching.reach[touch] + touches.growth[touch] + deflection - touches.depth[touch];
    const double of_ball = distance * radius / (radius + half_thickness);
    ball = {elements_at(scene, touching.ball[touch]), of_ball};
    segment = {share > 0.0 && share < 1.0 ? std::span<const int>(&touching.segment[touch], 1)
                                          : elements_at(scene, touches.node[touch]),
               distance - of_ball};
  }
};

/// Overwrites the friction of the touch of a contact, and adds it to friction_force (Eq. 44-47, E9b, E9d).
template <class S, class Before>
HWY_INLINE void rub_pair(const Scene& scene, S& state, TouchMemory& touching, const Touches& touches,
                         const Before& before, const ActiveContact& contact) {
  const int touch = contact.touch;
  const int side = touching.side[touch];
  const RubbedPair pair(scene, state, touching, touches, touch);
  const double turning = speed_by_turning(scene, state, pair.ball) + speed_by_turning(scene, state, pair.segment);
  const double slip = touches.slip[touch] + scene.schedule.time_step * side * turning;
  const double stiffness =
      scene.contact.stiffness / std::max(1.0, stiffening(state, pair.ball) + stiffening(state, pair.segment));
  const FrictionTransfer<Before> transfer = {scene, touching, touches, before};
  const double now = evaluate_friction(transfer.initial_friction(contact), stiffness, slip,
                                       scene.contact.friction * contact.normal_force);
  touching.friction[touch] = now;
  touching.pushed[touch] = contact.has_pair ? side : 0;
  // Along the segment where the ball touches its side, turned with the normal round its ends. The nodes of the
  // segment share the reaction by the lever rule.
  const Vector2& normal = touches.normal[touch];
  const Vector2 force = now * side * Vector2(normal.y(), -normal.x());
  const double share = touches.share[touch];
  state.friction_force[touching.ball[touch]] += force;
  state.friction_force[touches.start[touch]] -= (1.0 - share) * force;
  state.friction_force[touches.end[touch]] -= share * force;
  add_couple(scene, state, pair.ball, now * side);
  add_couple(scene, state, pair.segment, now * side);
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_CONTACT_TOUCH_FRICTION_INL_H_

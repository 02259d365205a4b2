// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_CONTACT_TOUCH_ACTIVE_CONTACTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_CONTACT_TOUCH_ACTIVE_CONTACTS_INL_H_
#undef CELLCRUSH_CONTACT_TOUCH_ACTIVE_CONTACTS_INL_H_
#else
#define CELLCRUSH_CONTACT_TOUCH_ACTIVE_CONTACTS_INL_H_
#endif

#include <cmath>

#include "contact/contact_workspace.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Difference up to which two touches are equally deep, over the thickness of the thinnest wall. In a symmetric crush
/// round-off alone tells them apart.
inline constexpr double kEqualDepth = 1e-6;

/// The touches of one ball.
struct BallTouches {
  const Touches& touches;
  PairRange range;
  double equal_depth;  ///< mm

  /// Whether the segments of two touches share a node.
  [[nodiscard]] HWY_INLINE bool are_joined(int a, int b) const {
    return share_a_node({touches.start[a], touches.end[a]}, {touches.start[b], touches.end[b]});
  }

  [[nodiscard]] HWY_INLINE bool is_inside(int touch) const {
    return touches.share[touch] > 0.0 && touches.share[touch] < 1.0;
  }

  /// Share of a touch in the contact of its ball with the polyline: all if it is deeper than the touches with joined
  /// segments, none if one of these is deeper. Two equally deep ones have a half each.
  [[nodiscard]] HWY_INLINE double share_in_polyline(int touch) const {
    int equals = 1;
    for (int other = range.first; other < range.end; ++other) {
      if (other == touch || !are_joined(touch, other)) {
        continue;
      }
      const double lead = touches.depth[other] - touches.depth[touch];
      if (std::abs(lead) <= equal_depth && is_inside(touch) && is_inside(other)) {
        ++equals;
      } else if (lead > 0.0 || (lead == 0.0 && other < touch)) {
        return 0.0;
      }
    }
    return 1.0 / equals;
  }

  /// The touch with the nearest node of the polyline of the pushing segment, if the ball touches the ball of that node.
  [[nodiscard]] HWY_INLINE int node_touch(int pushing) const {
    int nearest = ActiveContact::kNone;
    double depth = 0.0;
    for (int touch = range.first; touch < range.end; ++touch) {
      if (touches.node_depth[touch] > depth && (touch == pushing || are_joined(touch, pushing))) {
        nearest = touch;
        depth = touches.node_depth[touch];
      }
    }
    return nearest;
  }
};

/// Whether the ball faces the ball of the node itself, and does not lie above the side of one of its segments.
HWY_INLINE bool lies_before(const Scene& scene, const State& state, int ball, int node) {
  const Vector2 away = state.position[ball] - state.position[node];
  for (int k = scene.incidence_offset[node]; k < scene.incidence_offset[node + 1]; ++k) {
    const int e = scene.incidence[k];
    const bool begins = scene.elements[e].start == node;
    const int other = begins ? scene.elements[e].end : scene.elements[e].start;
    if (other != ball && (begins ? 1.0 : -1.0) * state.axis[e].dot(away) > 0.0) {
      return false;
    }
  }
  return true;
}

/// Divides the normal force between this touch and that of the node ball with the segments of the ball (E8b).
HWY_INLINE void share_with_node(const Scene& scene, const State& state, const ContactLists& lists,
                                const Touches& touches, ActiveContact& contact) {
  const int touch = contact.touch;
  const int ball = lists.touching.ball[touch];
  const double share = touches.share[touch];
  if (share > 0.0 && share < 1.0) {
    if (contact.node_touch != ActiveContact::kNone &&
        !lies_before(scene, state, touches.node[contact.node_touch], ball)) {
      contact.net_depth -= 0.5 * touches.node_depth[contact.node_touch] *
                           touches.normal[touch].dot(touches.node_normal[contact.node_touch]);
    }
    return;
  }
  // Two balls touch. The pair belongs to the first of them, or to the one that lies over the segments of the other.
  const int end = touches.node[touch];
  contact.has_pair = ball < end && lies_before(scene, state, end, ball);
  contact.net_depth = contact.has_pair ? contact.net_depth : 0.0;
}

/// Whether a touch exerts forces. Sets what it exerts, but for the normal force.
HWY_INLINE bool is_active(const Scene& scene, const State& state, const ContactLists& lists, const Touches& touches,
                          int touch, ActiveContact& contact) {
  const double depth = touches.depth[touch];
  if (!(depth > 0.0)) {
    return false;
  }
  contact = ActiveContact();
  contact.touch = touch;
  contact.net_depth = depth;
  // Most balls touch a single segment, between its ends.
  if (lists.touching.linked[touch] != 0 || touches.node_depth[touch] > 0.0) {
    const BallTouches of_ball = {touches, pairs_of_ball(lists.touching, lists.touching.ball[touch], touch),
                                 kEqualDepth * scene.contact.thinnest};
    contact.share = of_ball.share_in_polyline(touch);
    if (contact.share == 0.0) {
      return false;
    }
    contact.node_touch = of_ball.node_touch(touch);
    share_with_node(scene, state, lists, touches, contact);
  }
  return true;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_CONTACT_TOUCH_ACTIVE_CONTACTS_INL_H_

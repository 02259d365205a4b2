// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_CONTACT_TOUCH_NORMAL_FORCES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_CONTACT_TOUCH_NORMAL_FORCES_INL_H_
#undef CELLCRUSH_CONTACT_TOUCH_NORMAL_FORCES_INL_H_
#else
#define CELLCRUSH_CONTACT_TOUCH_NORMAL_FORCES_INL_H_
#endif

#include <algorithm>

#include "contact/contact_workspace.h"
#include "contact/thickening.h"
#include "contact/touch/force_laws.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Normal force of the pair of a contact (E8); its sum is kept for friction. 0 if the contact does not have the pair.
HWY_INLINE NormalForce force_of_pair(const Scene& scene, const Touches& touches, ActiveContact& contact) {
  if (!contact.has_pair) {
    return {0.0, 0.0};
  }
  const NormalForce net = without_pull(contact.share * scene.contact.stiffness * contact.net_depth,
                                       contact.share * touches.viscous[contact.touch]);
  contact.normal_force = net.elastic + net.viscous;
  return net;
}

/// Subtracts half of the energy and force of the touch of two balls (E8b). The ball of the node counts this pair as
/// well, and pushes on its own where the node lies under the segments of the ball.
template <class S>
HWY_INLINE void subtract_double_count(const Scene& scene, S& state, const TouchMemory& touching, const Touches& touches,
                                      const ActiveContact& contact, double& stored) {
  const int node_touch = contact.node_touch;
  const double stiffness = 0.5 * contact.share * scene.contact.stiffness;
  const double depth = touches.node_depth[node_touch];
  const Vector2 force = stiffness * depth * touches.node_normal[node_touch];
  state.contact_force[touching.ball[node_touch]].elastic -= force;
  state.contact_force[touches.node[node_touch]].elastic += force;
  stored -= 0.5 * stiffness * depth * depth;
  if (touches.growth[node_touch] > 0.0) {
    const int segment = touching.segment[node_touch];
    const double share = touches.node[node_touch] == scene.elements[segment].start ? 0.0 : 1.0;
    push_by_growth(scene, state, {touching.ball[node_touch], segment, share, 0.0, -stiffness * depth});
  }
}

/// Adds a share of the forces of a pair, elastic x and y, viscous x and y, to those of a particle.
HWY_INLINE void add_share(double share, const double* HWY_RESTRICT pair, ContactForce& to) {
  using Numbers = Lane<WideTag<double, 4>>;
  double* sums = to.elastic.data();
  for (std::size_t k = 0; k < 4; k += Numbers::kWidth) {
    (Numbers::load(sums + k) + share * Numbers::load(pair + k)).store(sums + k);
  }
}

/// Records the depth of a touch, divided by the thickness of the thinner wall, if it is the greatest so far.
HWY_INLINE void record_depth(const Scene& scene, const TouchMemory& touching, int touch, double depth, bool is_new,
                             ContactTotals& totals) {
  // Most touches are rejected before the thicknesses of their walls are loaded.
  if (!(depth > scene.contact.thinnest * (is_new ? totals.deepest_birth : totals.deepest_penetration))) {
    return;
  }
  const double thinner =
      std::min(2.0 * scene.radius[touching.ball[touch]], scene.elements[touching.segment[touch]].thickness);
  totals.deepest_penetration = std::max(totals.deepest_penetration, depth / thinner);
  if (is_new) {
    totals.deepest_birth = std::max(totals.deepest_birth, depth / thinner);
  }
}

/// Results of the evaluation of touches. Raw pointers: a store may alias the pointers of the vectors.
struct TouchArrays {
  const TouchMemory& touching;
  const Touches& touches;

  const int* balls = touching.ball.data();
  const int* starts = touches.start.data();
  const int* ends = touches.end.data();
  const int* known = touches.known.data();
  const double* growth = touches.growth.data();
  const double* depths = touches.depth.data();
  const double* shares = touches.share.data();
  const Vector2* normals = touches.normal.data();
};

/// Adds the normal force of a contact to `forces`, those of the state. `squared_depths` is the sum of the squared
/// depths that store energy, each with its share.
template <class S, class Forces>
HWY_INLINE void add_normal_force(const Scene& scene, S& state, const Forces& forces, const TouchArrays& of,
                                 ActiveContact& contact, double& squared_depths, ContactTotals& totals) {
  const int touch = contact.touch;
  const double depth = of.depths[touch];
  const Vector2 normal = of.normals[touch];
  const NormalForce net = force_of_pair(scene, of.touches, contact);
  const double elastic = contact.share * scene.contact.stiffness * depth;
  const double pair[] = {elastic * normal.x(), elastic * normal.y(), net.viscous * normal.x(),
                         net.viscous * normal.y()};
  const double share = of.shares[touch];
  add_share(1.0, pair, forces[of.balls[touch]]);
  add_share(share - 1.0, pair, forces[of.starts[touch]]);
  add_share(-share, pair, forces[of.ends[touch]]);
  squared_depths += contact.share * depth * depth;
  if (contact.node_touch != ActiveContact::kNone) {
    subtract_double_count(scene, state, of.touching, of.touches, contact, totals.stored);
  }
  if (HWY_UNLIKELY(of.growth[touch] > 0.0)) {
    push_by_growth(scene, state,
                   {of.balls[touch], of.touching.segment[touch], share, of.touches.offset[touch], elastic});
  }
  record_depth(scene, of.touching, touch, depth, of.known[touch] == Touches::kNew, totals);
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_CONTACT_TOUCH_NORMAL_FORCES_INL_H_

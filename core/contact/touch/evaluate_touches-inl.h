// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_CONTACT_TOUCH_EVALUATE_TOUCHES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_CONTACT_TOUCH_EVALUATE_TOUCHES_INL_H_
#undef CELLCRUSH_CONTACT_TOUCH_EVALUATE_TOUCHES_INL_H_
#else
#define CELLCRUSH_CONTACT_TOUCH_EVALUATE_TOUCHES_INL_H_
#endif

#include <cstddef>

#include "contact/contact_workspace.h"
#include "contact/start_overlaps.h"
#include "contact/touch_geometry-inl.h"
#include "simd/points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Inputs and results of the evaluation of pairs. Raw pointers: a store may alias the pointers of the vectors.
struct PairArrays {
  const Scene& scene;
  const State& state;
  ContactLists& lists;
  Touches& touches;

  const Element* elements = scene.elements.data();
  const double* inverse_mass = scene.inverse_mass.data();
  const Vector2* position = state.position.data();
  const Vector2* velocity = state.velocity.data();
  const Vector2* axis = state.axis.data();
  const double* length = state.length.data();
  const int* ball = lists.touching.ball.data();
  const int* segment = lists.touching.segment.data();
  const double* reach = lists.touching.reach.data();
  const double* radius_growth = state.radius_growth.data();
  const bool has_grown = lists.reach_growth > 0.0;
  const bool has_limits = !scene.limited_reaches.segment.empty() || !scene.start_overlaps.empty();
  int* side = lists.touching.side.data();
  int* start = touches.start.data();
  int* end = touches.end.data();
  double* growth = touches.growth.data();
  double* offset = touches.offset.data();
  double* share = touches.share.data();
  double* depth = touches.depth.data();
  Vector2* normal = touches.normal.data();
  double* viscous = touches.viscous.data();
  double* slip = touches.slip.data();
  int* node = touches.node.data();
  double* node_depth = touches.node_depth.data();
  Vector2* node_normal = touches.node_normal.data();
};

/// Stores the nodes of the segments of the lanes.
template <class D>
HWY_INLINE void note_nodes(const PairArrays& arrays, std::size_t i) {
  for (std::size_t lane = 0; lane < Lane<D>::kWidth; ++lane) {
    const Element& element = arrays.elements[arrays.segment[i + lane]];
    arrays.start[i + lane] = element.start;
    arrays.end[i + lane] = element.end;
  }
}

/// Distances at which the pairs of the lanes touch: at the foot of the ball, and at the nearer node.
template <class D>
struct Reaches {
  Lane<D> at_foot;
  Lane<D> at_node;
};

/// What limits the growth of the reaches of the lanes (E8a).
template <class D>
HWY_INLINE Lane<D> limits_of_growth(const PairArrays& arrays, Lane<D> before, std::size_t i) {
  double most[Lane<D>::kWidth];
  for (std::size_t lane = 0; lane < Lane<D>::kWidth; ++lane) {
    most[lane] = most_reach_now(arrays.scene, arrays.state, arrays.ball[i + lane], arrays.segment[i + lane]);
  }
  return Lane<D>::load(most) - before;
}

/// Current reaches of the lanes (E8d). Stores what they have grown by at the foot.
template <class D>
HWY_INLINE Reaches<D> current_reaches(const PairArrays& arrays, Lane<D> share, LaneMask<D> end_is_nearer,
                                      std::size_t i) {
  const Lane<D> zero = 0.0;
  const auto before = Lane<D>::load(arrays.reach + i);
  if (!arrays.has_grown) {
    zero.store(arrays.growth + i);
    return {before, before};
  }
  const auto of_ball = gather<D>(arrays.radius_growth, arrays.ball + i);
  auto at_start = of_ball + gather<D>(arrays.radius_growth, arrays.start + i);
  auto at_end = of_ball + gather<D>(arrays.radius_growth, arrays.end + i);
  if (arrays.has_limits && any(at_start + at_end > zero)) {
    const auto limit = limits_of_growth<D>(arrays, before, i);
    at_start = min(at_start, limit);
    at_end = min(at_end, limit);
  }
  const auto at_foot = fma(share_of_end(share), at_end - at_start, at_start);
  at_foot.store(arrays.growth + i);
  return {before + at_foot, before + select(end_is_nearer, at_end, at_start)};
}

/// Positions, velocities and inverse masses of the particles of the lanes.
template <class D>
struct LaneParticles {
  Points<D> position;
  Points<D> velocity;
  Lane<D> inverse_mass;
};

template <class D>
HWY_INLINE LaneParticles<D> gather_particles(const PairArrays& arrays, const int* particles) {
  LaneParticles<D> at;
  gather_together(arrays.position, arrays.velocity, arrays.inverse_mass, particles, at.position, at.velocity,
                  at.inverse_mass);
  return at;
}

/// The particles of the pairs of the lanes, all gathered before anything is stored.
template <class D>
struct LanePairs {
  LaneParticles<D> ball;
  LaneParticles<D> start;
  LaneParticles<D> end;
};

/// Foot of a ball on its segment, depth of the overlap, side of the segment and normal (Eq. 41-42, E8).
template <class D>
struct Foot {
  Lane<D> depth;
  Lane<D> share;
  Lane<D> side;  // +1 or -1
  Points<D> normal;
};

template <class D>
HWY_INLINE Foot<D> evaluate_foot(const PairArrays& arrays, const LanePairs<D>& at, std::size_t i) {
  const Lane<D> zero = 0.0;
  const Lane<D> one = 1.0;
  const Points<D> axis = gather<D>(arrays.axis, arrays.segment + i);
  const Lane<D> length = gather<D>(arrays.length, arrays.segment + i);
  const Points<D> from_start = at.ball.position - at.start.position;
  const Points<D> from_end = at.ball.position - at.end.position;
  const auto end_is_nearer = dot(from_end, from_end) < dot(from_start, from_start);
  const Points<D> from_node = select(end_is_nearer, from_end, from_start);
  const auto node_distance = sqrt(dot(from_node, from_node));
  const auto ahead = dot(from_start, axis);
  const auto inside = (ahead > zero) & (ahead < length);
  const auto at_end = select(ahead > zero, one, zero);
  const auto share = select(inside, ahead / length, at_end);
  const auto signed_distance = cross(axis, from_start);

  // Rolling round a free end changes the side.
  const auto before = Lane<D>::load(arrays.side + i);
  const auto now = select(signed_distance >= zero, one, -one);
  const auto side = select(inside & (before != zero), before, now);

  const Points<D> across = side * Points<D>{-axis.y, axis.x};
  const auto apart = node_distance > zero;
  const Points<D> node_normal = select(apart, (one / node_distance) * from_node, across);
  const Points<D> normal = select(inside, across, node_normal);
  const Reaches<D> reaches = current_reaches<D>(arrays, share, end_is_nearer, i);
  const auto reach = reaches.at_foot;
  const auto overlap = reach - select(inside, side * signed_distance, node_distance);
  // Pressed through and out of the other side, it no longer touches.
  const auto depth = masked(overlap < reach + reach, overlap);

  masked(depth > zero, side).store(arrays.side + i);
  depth.store(arrays.depth + i);
  share.store(arrays.share + i);
  normal.store(arrays.normal + i);
  select(end_is_nearer, Lane<D>::load(arrays.end + i), Lane<D>::load(arrays.start + i)).store(arrays.node + i);
  signed_distance.store(arrays.offset + i);
  masked(apart, reaches.at_node - node_distance).store(arrays.node_depth + i);
  node_normal.store(arrays.node_normal + i);
  return {depth, share, side, normal};
}

template <class D>
HWY_INLINE void evaluate_motion(const PairArrays& arrays, const LanePairs<D>& at, const Foot<D>& foot, std::size_t i) {
  const auto to_end = foot.share;
  const auto to_start = 1.0 - to_end;
  const auto closing = fma(to_start, at.start.velocity, fms(to_end, at.end.velocity, at.ball.velocity));
  const auto of_end = fma(to_end * to_end, at.end.inverse_mass, at.ball.inverse_mass);
  const auto inverse_mass = fma(to_start * to_start, at.start.inverse_mass, of_end);
  const auto& contact = arrays.scene.contact;
  const auto rate = dot(foot.normal, closing);
  viscous_force(contact.stiffness, contact.damping_ratio, inverse_mass, rate).store(arrays.viscous + i);
  const auto slide = foot.side * cross(foot.normal, closing);
  (arrays.scene.schedule.time_step * slide).store(arrays.slip + i);
}

/// Returns the lanes whose pairs are released.
template <class D>
HWY_INLINE LaneMask<D> evaluate_pairs(const PairArrays& arrays, std::size_t i) {
  note_nodes<D>(arrays, i);
  const LanePairs<D> at = {gather_particles<D>(arrays, arrays.ball + i), gather_particles<D>(arrays, arrays.start + i),
                           gather_particles<D>(arrays, arrays.end + i)};
  const Foot<D> foot = evaluate_foot(arrays, at, i);
  evaluate_motion(arrays, at, foot, i);
  return !(foot.depth > 0.0);
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_CONTACT_TOUCH_EVALUATE_TOUCHES_INL_H_

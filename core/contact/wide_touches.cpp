#include "contact/wide_touches.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/wide_touches.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kMostLanes = 8;

/// Balls and their segments with both particles, a pair a lane.
struct PairIndices {
  const int* ball;
  const int* segment;
  const int* start;
  const int* end;
};

template <class D>
HWY_INLINE PairIndices pair_indices(D d, const Scene& scene, const TouchMemory& touching, Touches& touches,
                                    std::size_t i) {
  const PairIndices pair = {&touching.ball[i], &touching.segment[i], &touches.start[i], &touches.end[i]};
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    const Element& element = scene.elements[pair.segment[lane]];
    touches.start[i + lane] = element.start;
    touches.end[i + lane] = element.end;
  }
  return pair;
}

template <class D>
HWY_INLINE Points<D> difference(const Points<D>& a, const Points<D>& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y)};
}

template <class D>
HWY_INLINE Points<D> choose(hn::Mask<D> mask, const Points<D>& yes, const Points<D>& no) {
  return {hn::IfThenElse(mask, yes.x, no.x), hn::IfThenElse(mask, yes.y, no.y)};
}

/// Where the foot of a ball lies, how deep, its side of the segment, and the normal there.
template <class D>
struct Stand {
  hn::Vec<D> depth;
  hn::Vec<D> share;
  hn::Vec<D> side;  // +1 or -1
  Points<D> normal;
};

template <class D>
HWY_INLINE Stand<D> evaluate_stand(D d, State& state, Touches& touches, const PairIndices& pair, std::size_t i) {
  const hn::Rebind<int, D> narrow;
  const auto zero = hn::Zero(d);
  const auto one = hn::Set(d, 1.0);
  const Vector2* positions = state.position.data();
  const Points<D> axis = gather_points(d, state.axis.data(), pair.segment);
  const auto length = gather_numbers(d, state.length.data(), pair.segment);
  const Points<D> ball = gather_points(d, positions, pair.ball);
  const Points<D> from_start = difference<D>(ball, gather_points(d, positions, pair.start));
  const Points<D> from_end = difference<D>(ball, gather_points(d, positions, pair.end));
  const auto end_is_nearer = hn::Lt(dot(from_end, from_end), dot(from_start, from_start));
  const Points<D> from_node = choose<D>(end_is_nearer, from_end, from_start);
  const auto node_distance = hn::Sqrt(dot(from_node, from_node));
  const auto ahead = dot(from_start, axis);
  const auto is_ahead = hn::Gt(ahead, zero);
  const auto inside = hn::And(is_ahead, hn::Lt(ahead, length));
  const auto at_end = hn::IfThenElse(is_ahead, one, zero);
  const auto share = hn::IfThenElse(inside, hn::Div(ahead, length), at_end);
  const auto signed_distance = cross(axis, from_start);

  // A ball that goes round an end comes to the other side by right.
  const auto before = hn::PromoteTo(d, hn::LoadU(narrow, &state.touching.side[i]));
  const auto now = hn::IfThenElse(hn::Ge(signed_distance, zero), one, hn::Set(d, -1.0));
  const auto side = hn::IfThenElse(hn::And(inside, hn::Ne(before, zero)), before, now);

  const Points<D> across = {hn::Neg(hn::Mul(side, axis.y)), hn::Mul(side, axis.x)};
  const auto apart = hn::Gt(node_distance, zero);
  const auto per_distance = hn::Div(one, node_distance);
  const Points<D> unit = {hn::Mul(from_node.x, per_distance), hn::Mul(from_node.y, per_distance)};
  const Points<D> node_normal = choose<D>(apart, unit, across);
  const auto reach = hn::LoadU(d, &state.touching.reach[i]);
  const auto distance = hn::IfThenElse(inside, hn::Mul(side, signed_distance), node_distance);
  const Points<D> normal = choose<D>(inside, across, node_normal);
  const auto overlap = hn::Sub(reach, distance);
  const auto depth = hn::IfThenElseZero(hn::Lt(overlap, hn::Add(reach, reach)), overlap);
  const auto side_kept = hn::IfThenElseZero(hn::Gt(depth, zero), side);
  hn::StoreU(hn::DemoteTo(narrow, side_kept), narrow, &state.touching.side[i]);
  hn::StoreU(depth, d, &touches.depth[i]);
  hn::StoreU(share, d, &touches.share[i]);
  store_points(d, normal, &touches.normal[i]);
  const auto node = hn::IfThenElse(end_is_nearer, hn::PromoteTo(d, hn::LoadU(narrow, pair.end)),
                                   hn::PromoteTo(d, hn::LoadU(narrow, pair.start)));
  hn::StoreU(hn::DemoteTo(narrow, node), narrow, &touches.node[i]);
  hn::StoreU(hn::IfThenElseZero(apart, hn::Sub(reach, node_distance)), d, &touches.node_depth[i]);
  store_points(d, node_normal, &touches.node_normal[i]);
  return {depth, share, side, normal};
}

template <class D>
HWY_INLINE void evaluate_motion(D d, const Scene& scene, const State& state, Touches& touches, const PairIndices& pair,
                                const Stand<D>& stand, std::size_t i) {
  const auto to_end = stand.share;
  const auto to_start = hn::Sub(hn::Set(d, 1.0), to_end);
  const Points<D> start = gather_points(d, state.velocity.data(), pair.start);
  const Points<D> end = gather_points(d, state.velocity.data(), pair.end);
  const Points<D> ball = gather_points(d, state.velocity.data(), pair.ball);
  const Points<D> closing = {hn::MulAdd(to_start, start.x, hn::MulSub(to_end, end.x, ball.x)),
                             hn::MulAdd(to_start, start.y, hn::MulSub(to_end, end.y, ball.y))};
  const double* inverse_masses = scene.inverse_mass.data();
  const auto of_start = gather_numbers(d, inverse_masses, pair.start);
  const auto of_end = gather_numbers(d, inverse_masses, pair.end);
  const auto of_ball = gather_numbers(d, inverse_masses, pair.ball);
  const auto inverse_mass =
      hn::MulAdd(hn::Mul(to_start, to_start), of_start, hn::MulAdd(hn::Mul(to_end, to_end), of_end, of_ball));
  const auto critical = hn::Sqrt(hn::Div(hn::Set(d, scene.contact.stiffness), inverse_mass));
  const auto damping = hn::Mul(hn::Set(d, 2.0 * scene.contact.damping_ratio), critical);
  hn::StoreU(hn::Mul(damping, dot(stand.normal, closing)), d, &touches.viscous[i]);
  const auto slide = hn::Mul(stand.side, cross(stand.normal, closing));
  hn::StoreU(hn::Mul(hn::Set(d, scene.schedule.time_step), slide), d, &touches.slip[i]);
}

/// Returns the lanes whose pairs have parted.
template <class D>
HWY_INLINE hn::Mask<D> evaluate_pairs(D d, const Scene& scene, State& state, Touches& touches, std::size_t i) {
  const PairIndices pair = pair_indices(d, scene, state.touching, touches, i);
  const Stand<D> stand = evaluate_stand(d, state, touches, pair, i);
  evaluate_motion(d, scene, state, touches, pair, stand, i);
  return hn::Not(hn::Gt(stand.depth, hn::Zero(d)));
}

std::size_t evaluate_all(const Scene& scene, State& state, Touches& touches, std::size_t first, std::size_t end,
                         int* parted) {
  const hn::CappedTag<double, kMostLanes> wide;
  const hn::CappedTag<double, 1> one;
  std::size_t parted_count = 0;
  std::size_t i = first;
  for (; i + hn::Lanes(wide) <= end; i += hn::Lanes(wide)) {
    const auto apart = evaluate_pairs(wide, scene, state, touches, i);
    parted_count += write_set_lanes(wide, apart, i, parted + parted_count);
  }
  for (; i < end; ++i) {
    const auto apart = evaluate_pairs(one, scene, state, touches, i);
    parted_count += write_set_lanes(one, apart, i, parted + parted_count);
  }
  return parted_count;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(evaluate_all);

std::size_t evaluate_touches_wide(const Scene& scene, State& state, Touches& touches, std::size_t first,
                                  std::size_t end, int* parted) {
  return HWY_DYNAMIC_DISPATCH(evaluate_all)(scene, state, touches, first, end, parted);
}

}  // namespace cellcrush
#endif

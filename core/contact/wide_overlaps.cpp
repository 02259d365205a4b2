#include "contact/wide_overlaps.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/wide_overlaps.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <limits>

#include "contact/candidate_lists.h"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr int kMostLanes = 8;

/// How balls stand to segments, w being the way from the segment's start to the ball and u the segment.
template <class D>
struct Standing {
  hn::Vec<D> reach;
  hn::Vec<D> squared_distance;  // w.w, from the start
  hn::Vec<D> foot;              // w.u
  hn::Vec<D> squared_length;    // u.u
};

template <class D>
HWY_INLINE Standing<D> standing_of(D d, const Scene& scene, const State& state, const AwakeCandidates& awake,
                                   std::size_t i) {
  const Vector2* positions = state.position.data();
  int start_nodes[kMostLanes];
  int end_nodes[kMostLanes];
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    const Element& element = scene.elements[awake.segment[i + lane]];
    start_nodes[lane] = element.start;
    end_nodes[lane] = element.end;
  }
  const Points<D> start = gather_points(d, positions, start_nodes);
  const Points<D> end = gather_points(d, positions, end_nodes);
  const Points<D> ball = gather_points(d, positions, &awake.ball[i]);
  const Points<D> along = {hn::Sub(end.x, start.x), hn::Sub(end.y, start.y)};
  const Points<D> away = {hn::Sub(ball.x, start.x), hn::Sub(ball.y, start.y)};
  return {hn::LoadU(d, &awake.reach[i]), dot(away, away), dot(away, along), dot(along, along)};
}

/// Lanes whose ball is nearer to its segment than their reach: to the line along it where the ball stands beside it, else to
/// the nearer end. Without a division: the square of the distance to the line is w.w - (w.u)^2 / u.u.
template <class D>
HWY_INLINE hn::Mask<D> overlap(D d, const Standing<D>& at) {
  const auto zero = hn::Zero(d);
  const auto beyond_reach = hn::NegMulAdd(at.reach, at.reach, at.squared_distance);  // of the start, squares
  const auto at_start = hn::Lt(beyond_reach, zero);
  const auto of_end = hn::Add(hn::Sub(beyond_reach, hn::Add(at.foot, at.foot)), at.squared_length);
  const auto at_end = hn::Lt(of_end, zero);
  const auto beside = hn::Lt(hn::Mul(beyond_reach, at.squared_length), hn::Mul(at.foot, at.foot));
  const auto stands_beside = hn::And(hn::Gt(at.foot, zero), hn::Lt(at.foot, at.squared_length));
  return hn::Or(hn::Or(at_start, at_end), hn::And(stands_beside, beside));
}

/// Distances beyond touch.
template <class D>
HWY_INLINE hn::Vec<D> gap(D d, const Standing<D>& at) {
  const auto zero = hn::Zero(d);
  const auto share = hn::Div(hn::Min(hn::Max(at.foot, zero), at.squared_length), at.squared_length);
  // w.w - 2 s w.u + s^2 u.u
  const auto part = hn::NegMulAdd(share, at.squared_length, hn::Add(at.foot, at.foot));
  const auto squared = hn::NegMulAdd(share, part, at.squared_distance);
  return hn::Sub(hn::Sqrt(hn::Max(squared, zero)), at.reach);
}

std::size_t find_awake(const State& state, std::size_t first, std::size_t end, int* places) {
  const hn::CappedTag<double, kCandidateBatch> d;
  std::size_t count = 0;
  for (std::size_t batch = first; batch < end; batch += kCandidateBatch) {
    const auto travel = hn::Set(d, travel_of_batch(state, batch / kCandidateBatch));
    for (std::size_t place = batch; place < batch + kCandidateBatch; place += hn::Lanes(d)) {
      const auto asleep = hn::Lt(travel, hn::LoadU(d, &state.candidate_alarm[place]));
      count += write_set_lanes(d, hn::Not(asleep), place, places + count);
    }
  }
  return count;
}

template <class D>
HWY_INLINE void test(D d, const Scene& scene, const State& state, AwakeCandidates& awake, std::size_t i) {
  const Standing<D> at = standing_of(d, scene, state, awake, i);
  const auto next = hn::Add(hn::LoadU(d, &awake.travel[i]), gap(d, at));
  const auto never = hn::Set(d, std::numeric_limits<double>::infinity());
  hn::StoreU(hn::IfThenElse(overlap(d, at), never, next), d, &awake.alarm[i]);
}

void test_awake(const Scene& scene, const State& state, AwakeCandidates& awake) {
  const hn::CappedTag<double, kMostLanes> wide;
  const hn::CappedTag<double, 1> one;
  std::size_t i = 0;
  for (; i + hn::Lanes(wide) <= awake.count; i += hn::Lanes(wide)) {
    test(wide, scene, state, awake, i);
  }
  for (; i < awake.count; ++i) {
    test(one, scene, state, awake, i);
  }
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(find_awake);
HWY_EXPORT(test_awake);

std::size_t find_awake_wide(const State& state, std::size_t first, std::size_t end, int* places) {
  return HWY_DYNAMIC_DISPATCH(find_awake)(state, first, end, places);
}

void test_awake_wide(const Scene& scene, const State& state, AwakeCandidates& awake) {
  HWY_DYNAMIC_DISPATCH(test_awake)(scene, state, awake);
}

}  // namespace cellcrush
#endif

#include "contact/wide_overlaps.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/wide_overlaps.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <bit>
#include <limits>

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Doubles = hn::CappedTag<double, kCandidateBatch>;
constexpr int kLanes = hn::MaxLanes(Doubles());

/// How balls stand to segments, w being the way from the segment's start to the ball and u the segment.
struct Standing {
  hn::Vec<Doubles> reach;
  hn::Vec<Doubles> squared_distance;  // w.w, from the start
  hn::Vec<Doubles> foot;              // w.u
  hn::Vec<Doubles> squared_length;    // u.u
};

HWY_INLINE Standing standing_at(const Scene& scene, const State& state, std::size_t place) {
  constexpr int kInts = sizeof(Element) / sizeof(int);
  const Doubles d;
  const hn::RebindToSigned<Doubles> wide;
  const hn::Rebind<int, Doubles> narrow;
  const Vector2* positions = state.position.data();
  const auto segment = hn::Mul(hn::LoadU(narrow, &state.candidate_segment[place]), hn::Set(narrow, kInts));
  const auto node = [&](const int* nodes) HWY_ATTR {
    return gather_points(d, positions, hn::PromoteTo(wide, hn::GatherIndex(narrow, nodes, segment)));
  };
  const Points<Doubles> start = node(&scene.elements.front().start);
  const Points<Doubles> end = node(&scene.elements.front().end);
  const Points<Doubles> ball = gather_points(d, positions, load_indices(d, &state.candidate_ball[place]));
  const Points<Doubles> along = {hn::Sub(end.x, start.x), hn::Sub(end.y, start.y)};
  const Points<Doubles> away = {hn::Sub(ball.x, start.x), hn::Sub(ball.y, start.y)};
  return {hn::LoadU(d, &state.candidate_reach[place]), dot(away, away), dot(away, along), dot(along, along)};
}

/// Lanes whose ball is nearer to its segment than their reach: to the line along it where the ball stands beside it, else to
/// the nearer end. Without a division: the square of the distance to the line is w.w - (w.u)^2 / u.u.
HWY_INLINE hn::Mask<Doubles> overlap(const Standing& at) {
  const auto zero = hn::Zero(Doubles());
  const auto beyond_reach = hn::NegMulAdd(at.reach, at.reach, at.squared_distance);  // of the start, squares
  const auto at_start = hn::Lt(beyond_reach, zero);
  const auto of_end = hn::Add(hn::Sub(beyond_reach, hn::Add(at.foot, at.foot)), at.squared_length);
  const auto at_end = hn::Lt(of_end, zero);
  const auto beside = hn::Lt(hn::Mul(beyond_reach, at.squared_length), hn::Mul(at.foot, at.foot));
  const auto stands_beside = hn::And(hn::Gt(at.foot, zero), hn::Lt(at.foot, at.squared_length));
  return hn::Or(hn::Or(at_start, at_end), hn::And(stands_beside, beside));
}

/// Distances beyond touch; infinite of empty places.
HWY_INLINE hn::Vec<Doubles> gap(const Standing& at) {
  const Doubles d;
  const auto zero = hn::Zero(d);
  const auto share = hn::Div(hn::Min(hn::Max(at.foot, zero), at.squared_length), at.squared_length);
  // w.w - 2 s w.u + s^2 u.u
  const auto part = hn::NegMulAdd(share, at.squared_length, hn::Add(at.foot, at.foot));
  const auto squared = hn::NegMulAdd(share, part, at.squared_distance);
  const auto distance = hn::Sqrt(hn::Max(squared, zero));
  const auto never = hn::Set(d, std::numeric_limits<double>::infinity());
  return hn::IfThenElse(hn::Gt(at.reach, zero), hn::Sub(distance, at.reach), never);
}

/// Notes the places of a batch that overlap; where none does, sets its alarm if it has one.
HWY_INLINE std::size_t test_batch(const Scene& scene, const State& state, std::size_t batch, double travel,
                                  double* alarm, std::int64_t* found) {
  const Doubles d;
  const hn::RebindToSigned<Doubles> places;
  Standing at[kCandidateBatch / kLanes];
  std::size_t count = 0;
  for (int part = 0; part < kCandidateBatch / kLanes; ++part) {
    const std::size_t place = batch * kCandidateBatch + part * kLanes;
    at[part] = standing_at(scene, state, place);
    const auto overlaps = hn::RebindMask(places, overlap(at[part]));
    count += hn::CompressStore(hn::Iota(places, static_cast<std::int64_t>(place)), overlaps, places, found + count);
  }
  if (alarm != nullptr) {
    *alarm = 0.0;
    if (count == 0) {
      auto least = gap(at[0]);
      for (int part = 1; part < kCandidateBatch / kLanes; ++part) {
        least = hn::Min(least, gap(at[part]));
      }
      *alarm = travel + hn::GetLane(hn::MinOfLanes(d, least));
    }
  }
  return count;
}

/// Bit i: batch first + i is to be tested. As many as there are lanes.
HWY_INLINE unsigned awake(const State& state, std::size_t first) {
  const Doubles d;
  const auto travel = hn::GatherIndex(d, state.group_travel.data(), load_indices(d, &state.batch_group[first]));
  const auto sleeps = hn::Lt(travel, hn::LoadU(d, &state.batch_alarm[first]));
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, hn::Not(sleeps), bits);
  return bits[0];
}

std::size_t find_overlapping(const Scene& scene, State& state, std::size_t first, std::size_t end,
                             std::int64_t* found) {
  std::size_t count = 0;
  if (state.batch_alarm.empty()) {
    for (std::size_t batch = first; batch < end; ++batch) {
      count += test_batch(scene, state, batch, 0.0, nullptr, found + count);
    }
    return count;
  }
  const auto test = [&](std::size_t batch) HWY_ATTR {
    const double travel = state.group_travel[state.batch_group[batch]];
    count += test_batch(scene, state, batch, travel, &state.batch_alarm[batch], found + count);
  };
  std::size_t batch = first;
  for (; batch + kLanes <= end; batch += kLanes) {
    for (unsigned bits = awake(state, batch); bits != 0; bits &= bits - 1) {
      test(batch + std::countr_zero(bits));
    }
  }
  for (; batch < end; ++batch) {
    if (!(state.group_travel[state.batch_group[batch]] < state.batch_alarm[batch])) {
      test(batch);
    }
  }
  return count;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(find_overlapping);

std::size_t find_overlapping_wide(const Scene& scene, State& state, std::size_t first, std::size_t end,
                                  std::int64_t* found) {
  return HWY_DYNAMIC_DISPATCH(find_overlapping)(scene, state, first, end, found);
}

}  // namespace cellcrush
#endif

#include "contact/wide_overlaps.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/wide_overlaps.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Lanes whose ball is nearer to its segment than their reach: to the line along it where the ball stands beside it, else to
/// the nearer end. Without a division: with w from the start to the ball and u along the segment, the square of the distance
/// to the line is w.w - (w.u)^2 / u.u.
template <class D>
HWY_INLINE hn::Mask<D> overlap(D d, const Scene& scene, const State& state, std::size_t place) {
  constexpr int kInts = sizeof(Element) / sizeof(int);
  const Vector2* positions = state.position.data();
  const hn::RebindToSigned<D> wide;
  const hn::Rebind<int, D> narrow;
  const auto segment = hn::Mul(hn::LoadU(narrow, &state.candidate_segment[place]), hn::Set(narrow, kInts));
  const auto node = [&](const int* nodes) HWY_ATTR {
    return gather_points(d, positions, hn::PromoteTo(wide, hn::GatherIndex(narrow, nodes, segment)));
  };
  const Points<D> start = node(&scene.elements.front().start);
  const Points<D> end = node(&scene.elements.front().end);
  const Points<D> ball = gather_points(d, positions, load_indices(d, &state.candidate_ball[place]));
  const auto reach = hn::LoadU(d, &state.candidate_reach[place]);
  const Points<D> along = {hn::Sub(end.x, start.x), hn::Sub(end.y, start.y)};
  const Points<D> away = {hn::Sub(ball.x, start.x), hn::Sub(ball.y, start.y)};
  const auto foot = dot(away, along);
  const auto length = dot(along, along);
  const auto beyond_reach = hn::NegMulAdd(reach, reach, dot(away, away));  // of the start, squares
  const auto zero = hn::Zero(d);
  const auto at_start = hn::Lt(beyond_reach, zero);
  const auto at_end = hn::Lt(hn::Add(hn::Sub(beyond_reach, hn::Add(foot, foot)), length), zero);
  const auto beside = hn::Lt(hn::Mul(beyond_reach, length), hn::Mul(foot, foot));
  const auto stands_beside = hn::And(hn::Gt(foot, zero), hn::Lt(foot, length));
  return hn::Or(hn::Or(at_start, at_end), hn::And(stands_beside, beside));
}

std::size_t find_overlapping(const Scene& scene, const State& state, std::size_t first, std::size_t end,
                             std::span<std::int64_t> found) {
  const hn::CappedTag<double, kSparePlaces> wide;
  const hn::CappedTag<double, 1> one;
  const hn::RebindToSigned<decltype(wide)> places;
  std::size_t count = 0;
  std::size_t place = first;
  for (; place + hn::Lanes(wide) <= end; place += hn::Lanes(wide)) {
    const auto overlaps = hn::RebindMask(places, overlap(wide, scene, state, place));
    count += hn::CompressStore(hn::Iota(places, static_cast<std::int64_t>(place)), overlaps, places, &found[count]);
  }
  for (; place < end; ++place) {
    found[count] = static_cast<std::int64_t>(place);
    count += hn::AllTrue(one, overlap(one, scene, state, place)) ? 1 : 0;
  }
  return count;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(find_overlapping);

std::size_t find_overlapping_wide(const Scene& scene, const State& state, std::size_t first, std::size_t end,
                                  std::span<std::int64_t> found) {
  return HWY_DYNAMIC_DISPATCH(find_overlapping)(scene, state, first, end, found);
}

}  // namespace cellcrush
#endif

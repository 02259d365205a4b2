#include "touch/find_overlaps.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "touch/find_overlaps.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <span>
#include <vector>

#include "cellcrush/tuning.h"
#include "search/list_room.h"
#include "simd/points-inl.h"
#include "touch/awake_candidates.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

using Wide = WideTag<double, 8>;
using One = hn::CappedTag<double, 1>;

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Gathered data of the candidates that are tested together.
struct Tested {
  int ball[kTestedTogether];
  int start[kTestedTogether];  ///< nodes of the segment
  int end[kTestedTogether];
  double reach[kTestedTogether];
  /// Of the group. In a search by buckets -infinity, so that every candidate is tested in every step.
  double travel[kTestedTogether];
};

// Raw pointers: a store may alias the pointers of the vectors.
void collect(const Scene& scene, const ContactLists& lists, std::span<const int> places, Tested& tested) {
  const Element* elements = scene.elements.data();
  const int* balls = lists.candidate_ball.data();
  const int* segments = lists.candidate_segment.data();
  const double* reaches = lists.candidate_reach.data();
  const int* groups = lists.batch_group.data();
  const double* travels = lists.group_travel.data();
  const bool sleeps = !lists.batch_group.empty();
  for (std::size_t i = 0; i < places.size(); ++i) {
    const int place = places[i];
    const Element& element = elements[segments[place]];
    tested.ball[i] = balls[place];
    tested.start[i] = element.start;
    tested.end[i] = element.end;
    tested.reach[i] = reaches[place];
    tested.travel[i] = sleeps ? travels[groups[place / kCandidateBatch]] : -kNever;
  }
}

/// Balls relative to segments. w points from the start of the segment to the ball, u is the segment.
template <class D>
struct Standing {
  Lane<D> reach;
  Lane<D> squared_distance;  // w.w, from the start
  Lane<D> foot;              // w.u
  Lane<D> squared_length;    // u.u
};

template <class D>
HWY_INLINE Standing<D> standing_of(const Vector2* positions, const Tested& tested, std::size_t i) {
  const Points<D> start = gather<D>(positions, tested.start + i);
  const Points<D> end = gather<D>(positions, tested.end + i);
  const Points<D> ball = gather<D>(positions, tested.ball + i);
  const Points<D> u = end - start;
  const Points<D> w = ball - start;
  return {Lane<D>::load(tested.reach + i), dot(w, w), dot(w, u), dot(u, u)};
}

/// Lanes whose ball is nearer to its segment than their reach (E8, E8a): to its line if the ball is beside it,
/// otherwise to the nearer end. No division is needed: the squared distance from the line is w.w - (w.u)^2 / u.u.
template <class D>
HWY_INLINE LaneMask<D> overlap(const Standing<D>& at) {
  const Lane<D> zero = 0.0;
  const auto beyond_start = fnma(at.reach, at.reach, at.squared_distance);  // w.w - reach^2
  const auto beyond_end = beyond_start - (at.foot + at.foot) + at.squared_length;
  const auto near_line = beyond_start * at.squared_length < at.foot * at.foot;
  const auto beside = (at.foot > zero) & (at.foot < at.squared_length);
  return (beyond_start < zero) | (beyond_end < zero) | (beside & near_line);
}

/// Gaps, mm: distances minus reach.
template <class D>
HWY_INLINE Lane<D> gap(const Standing<D>& at) {
  const Lane<D> zero = 0.0;
  const auto share = min(max(at.foot, zero), at.squared_length) / at.squared_length;
  // w.w - 2 s w.u + s^2 u.u
  const auto squared = fnma(share, fnma(share, at.squared_length, at.foot + at.foot), at.squared_distance);
  return sqrt(max(squared, zero)) - at.reach;
}

/// Finds the travel at which each candidate is next checked, and returns the lanes of those that overlap.
template <class D>
HWY_INLINE LaneMask<D> test(const Vector2* positions, const Tested& tested, std::size_t i, double* next_checks) {
  const Standing<D> at = standing_of<D>(positions, tested, i);
  const auto overlaps = overlap(at);
  const auto next = Lane<D>::load(tested.travel + i) + gap(at);
  select(overlaps, Lane<D>(kNever), next).store(next_checks + i);
  return overlaps;
}

/// Sets the next checks of candidates that are tested together. Appends the indices of those that overlap to `found`.
void test_some(const Scene& scene, const State& state, ContactLists& lists, std::span<const int> places,
               std::vector<int>& found) {
  Tested tested;
  collect(scene, lists, places, tested);
  const Vector2* positions = state.position.data();
  double next_checks[kTestedTogether];
  const auto note = [&](std::size_t i, unsigned bits) {
    for (; bits != 0; bits &= bits - 1) {
      found.push_back(places[i + std::countr_zero(bits)]);
    }
  };
  std::size_t i = 0;
  for (; i + Lane<Wide>::kWidth <= places.size(); i += Lane<Wide>::kWidth) {
    note(i, bits_of(test<Wide>(positions, tested, i, next_checks)));
  }
  for (; i < places.size(); ++i) {
    note(i, bits_of(test<One>(positions, tested, i, next_checks)));
  }
  double* of_all = lists.candidate_next_check_travel.data();
  for (i = 0; i < places.size(); ++i) {
    of_all[places[i]] = next_checks[i];
  }
}

void test_awake(const Scene& scene, const State& state, ContactLists& lists, std::span<const int> places,
                std::vector<int>& found) {
  for (std::size_t i = 0; i < places.size(); i += kTestedTogether) {
    test_some(scene, state, lists, places.subspan(i, std::min(kTestedTogether, places.size() - i)), found);
  }
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {
namespace {

HWY_EXPORT(test_awake);

/// The candidates from `first` to `end` that overlap; sets the next checks of the others that are awake.
void find_overlaps_in(const Scene& scene, const State& state, ContactLists& lists, std::size_t first, std::size_t end,
                      ContactPart& part) {
  if (part.awake.size() < end - first + kCandidateBatch) {
    resize_with_room(part.awake, end - first + kCandidateBatch);
  }
  const std::size_t count = find_awake_candidates(lists, first, end, part.awake.data());
  part.found.clear();
  HWY_DYNAMIC_DISPATCH(test_awake)(scene, state, lists, std::span(part.awake).first(count), part.found);
}

}  // namespace

void find_overlaps(const Scene& scene, const State& state, ContactLists& lists, ContactWorkspace& workspace,
                   Workers& workers) {
  workers.parallel_ranges(lists.candidate_ball.size(), kCandidateBatch,
                          [&](std::size_t part, std::size_t first, std::size_t end) {
                            find_overlaps_in(scene, state, lists, first, end, workspace.parts[part]);
                          });
  workspace.found.clear();
  for (const ContactPart& part : workspace.parts) {
    workspace.found.insert(workspace.found.end(), part.found.begin(), part.found.end());
  }
}

}  // namespace cellcrush
#endif

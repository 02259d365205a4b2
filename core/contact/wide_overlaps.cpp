#include "contact/wide_overlaps.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/wide_overlaps.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>
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

/// Candidates whose numbers are brought together before they are tested, so that the processor has them side by side.
constexpr std::size_t kTestedTogether = 64;

/// What some candidates are tested by; of each its own.
struct Tested {
  int ball[kTestedTogether];
  int start[kTestedTogether];  ///< nodes of the segment
  int end[kTestedTogether];
  double reach[kTestedTogether];
  double travel[kTestedTogether];  ///< of the group; by buckets the lowest there is
};

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
    tested.travel[i] = sleeps ? travels[groups[place / kCandidateBatch]] : -std::numeric_limits<double>::infinity();
  }
}

template <class D>
HWY_INLINE Standing<D> standing_of(D d, const Vector2* positions, const Tested& tested, std::size_t i) {
  const Points<D> start = gather_points(d, positions, tested.start + i);
  const Points<D> end = gather_points(d, positions, tested.end + i);
  const Points<D> ball = gather_points(d, positions, tested.ball + i);
  const Points<D> along = {hn::Sub(end.x, start.x), hn::Sub(end.y, start.y)};
  const Points<D> away = {hn::Sub(ball.x, start.x), hn::Sub(ball.y, start.y)};
  return {hn::LoadU(d, tested.reach + i), dot(away, away), dot(away, along), dot(along, along)};
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

/// Bits of the candidates of batches that are awake.
class AwakeBits {
 public:
  explicit AwakeBits(const ContactLists& lists)
      : alarms_(lists.candidate_alarm.data()),
        travels_(lists.group_travel.data()),
        groups_(lists.batch_group.empty() ? nullptr : lists.batch_group.data()) {}

  HWY_INLINE std::uint64_t of_batch(std::size_t batch) const {
    const hn::CappedTag<double, kCandidateBatch> d;
    const auto travelled = hn::Set(d, groups_ == nullptr ? 0.0 : travels_[groups_[batch]]);  // see travel_of_batch
    std::uint64_t bits = 0;
    for (std::size_t lane = 0; lane < kCandidateBatch; lane += hn::Lanes(d)) {
      const auto asleep = hn::Lt(travelled, hn::LoadU(d, alarms_ + batch * kCandidateBatch + lane));
      bits |= std::uint64_t{bits_of(d, hn::Not(asleep))} << lane;
    }
    return bits;
  }

 private:
  const double* const alarms_;
  const double* const travels_;
  const int* const groups_;
};

// Few candidates are awake, and which cannot be foretold: a branch at every batch takes three times as long.
std::size_t find_awake(const ContactLists& lists, std::size_t first, std::size_t end, int* places) {
  const AwakeBits awake(lists);
  const std::size_t end_batch = end / kCandidateBatch;
  std::size_t count = 0;
#if HWY_TARGET <= HWY_AVX3
  // A batch's places are stored whole, those that are awake first.
  const __m256i lanes = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  for (std::size_t batch = first / kCandidateBatch; batch < end_batch; ++batch) {
    const auto bits = static_cast<__mmask8>(awake.of_batch(batch));
    const __m256i numbers = _mm256_add_epi32(lanes, _mm256_set1_epi32(static_cast<int>(batch * kCandidateBatch)));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(places + count), _mm256_maskz_compress_epi32(bits, numbers));
    count += static_cast<std::size_t>(std::popcount(bits));
  }
#else
  constexpr std::size_t kBatchesInWord = 64 / kCandidateBatch;
  for (std::size_t batch = first / kCandidateBatch; batch < end_batch; batch += kBatchesInWord) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < std::min(kBatchesInWord, end_batch - batch); ++i) {
      bits |= awake.of_batch(batch + i) << (i * kCandidateBatch);
    }
    for (; bits != 0; bits &= bits - 1) {
      places[count++] = static_cast<int>(batch * kCandidateBatch) + std::countr_zero(bits);
    }
  }
#endif
  return count;
}

/// Finds the alarms of the candidates, and returns the bits of those that overlap.
template <class D>
HWY_INLINE unsigned test(D d, const Vector2* positions, const Tested& tested, std::size_t i, double* alarms) {
  const Standing<D> at = standing_of(d, positions, tested, i);
  const auto overlaps = overlap(d, at);
  const auto next = hn::Add(hn::LoadU(d, tested.travel + i), gap(d, at));
  hn::StoreU(hn::IfThenElse(overlaps, hn::Set(d, std::numeric_limits<double>::infinity()), next), d, alarms + i);
  return bits_of(d, overlaps);
}

/// Sets the alarms of candidates that are tested together; adds those that overlap to the places found.
void test_some(const Scene& scene, const State& state, ContactLists& lists, std::span<const int> places,
               std::vector<int>& found) {
  const hn::CappedTag<double, kMostLanes> wide;
  const hn::CappedTag<double, 1> one;
  Tested tested;
  collect(scene, lists, places, tested);
  const Vector2* positions = state.position.data();
  double alarms[kTestedTogether];
  const auto note = [&](std::size_t i, unsigned bits) {
    for (; bits != 0; bits &= bits - 1) {
      found.push_back(places[i + std::countr_zero(bits)]);
    }
  };
  std::size_t i = 0;
  for (; i + hn::Lanes(wide) <= places.size(); i += hn::Lanes(wide)) {
    note(i, test(wide, positions, tested, i, alarms));
  }
  for (; i < places.size(); ++i) {
    note(i, test(one, positions, tested, i, alarms));
  }
  double* next_alarms = lists.candidate_alarm.data();
  for (i = 0; i < places.size(); ++i) {
    next_alarms[places[i]] = alarms[i];
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

HWY_EXPORT(find_awake);
HWY_EXPORT(test_awake);

std::size_t find_awake_wide(const ContactLists& lists, std::size_t first, std::size_t end, int* places) {
  return HWY_DYNAMIC_DISPATCH(find_awake)(lists, first, end, places);
}

void test_awake_wide(const Scene& scene, const State& state, ContactLists& lists, std::span<const int> places,
                     std::vector<int>& found) {
  HWY_DYNAMIC_DISPATCH(test_awake)(scene, state, lists, places, found);
}

}  // namespace cellcrush
#endif

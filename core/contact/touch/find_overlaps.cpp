#include "contact/touch/contact_stages.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "contact/touch/find_overlaps.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "cellcrush/tuning.h"
#include "contact/search/candidate_lists.h"
#include "contact/touch/overlap-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

using Wide = WideTag<double, kCandidateBatch>;
using Numbers = Lane<Wide>;

constexpr double kNever = std::numeric_limits<double>::infinity();

/// Bits of the awake candidates of a batch.
struct AwakeBits {
  const ContactLists& lists;
  const double* next_checks = lists.candidate_next_check_travel.data();
  const double* travels = lists.group_travel.data();
  const int* groups = lists.batch_group.empty() ? nullptr : lists.batch_group.data();

  HWY_INLINE std::uint64_t of_batch(std::size_t batch) const {
    // In a search by buckets none sleeps.
    const Numbers travelled = groups == nullptr ? 0.0 : travels[groups[batch]];
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < kCandidateBatch; i += Numbers::kWidth) {
      const auto asleep = travelled < Numbers::load(next_checks + batch * kCandidateBatch + i);
      bits |= std::uint64_t{bits_of(!asleep)} << i;
    }
    return bits;
  }
};

// Few candidates are awake, in no predictable pattern: with a branch at every batch this takes three times as long.
std::size_t find_awake(const ContactLists& lists, std::size_t first, std::size_t end, int* awake) {
  const AwakeBits bits_at = {lists};
  const std::size_t end_batch = end / kCandidateBatch;
  std::size_t count = 0;
#if HWY_TARGET <= HWY_AVX3
  // The indices of a batch are stored whole, those of awake candidates first.
  const __m256i lanes = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
  for (std::size_t batch = first / kCandidateBatch; batch < end_batch; ++batch) {
    const auto bits = static_cast<__mmask8>(bits_at.of_batch(batch));
    const __m256i numbers = _mm256_add_epi32(lanes, _mm256_set1_epi32(static_cast<int>(batch * kCandidateBatch)));
    _mm256_storeu_si256(reinterpret_cast<__m256i*>(awake + count), _mm256_maskz_compress_epi32(bits, numbers));
    count += static_cast<std::size_t>(std::popcount(bits));
  }
#else
  constexpr std::size_t kBatchesInWord = 64 / kCandidateBatch;
  for (std::size_t batch = first / kCandidateBatch; batch < end_batch; batch += kBatchesInWord) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < std::min(kBatchesInWord, end_batch - batch); ++i) {
      bits |= bits_at.of_batch(batch + i) << (i * kCandidateBatch);
    }
    for (; bits != 0; bits &= bits - 1) {
      awake[count++] = static_cast<int>(batch * kCandidateBatch) + std::countr_zero(bits);
    }
  }
#endif
  return count;
}

/// Gathered data of the candidates that are tested together.
struct Tested {
  int ball[kTestedTogether];
  int start[kTestedTogether];  ///< nodes of the segment
  int end[kTestedTogether];
  double reach[kTestedTogether];  ///< at the start of the segment
  double taper[kTestedTogether];  ///< what it is more at its end (E8d)
  /// Of the group. In a search by buckets -infinity, so that every candidate is tested in every step.
  double travel[kTestedTogether];
};

// Raw pointers: a store may alias the pointers of the vectors.
void collect(const Scene& scene, const State& state, const ContactLists& lists, std::span<const int> awake,
             Tested& tested) {
  const Element* elements = scene.elements.data();
  const int* balls = lists.candidate_ball.data();
  const int* segments = lists.candidate_segment.data();
  const double* reaches = lists.candidate_reach.data();
  const int* groups = lists.batch_group.data();
  const double* travels = lists.group_travel.data();
  const bool sleeps = !lists.batch_group.empty();
  const bool has_grown = lists.reach_growth > 0.0;
  for (std::size_t i = 0; i < awake.size(); ++i) {
    const int index = awake[i];
    const Element& element = elements[segments[index]];
    tested.ball[i] = balls[index];
    tested.start[i] = element.start;
    tested.end[i] = element.end;
    tested.reach[i] = reaches[index];
    tested.taper[i] = 0.0;
    if (has_grown) {
      const GrownReach now = grown_reach(scene, state, tested.ball[i], segments[index], tested.reach[i]);
      tested.reach[i] = now.at_start;
      tested.taper[i] = now.taper;
    }
    tested.travel[i] = sleeps ? travels[groups[index / kCandidateBatch]] : -kNever;
  }
}

HWY_INLINE RelativePosition<Wide> position_of(const Vector2* positions, const Tested& tested, std::size_t i) {
  const Points<Wide> start = gather<Wide>(positions, tested.start + i);
  const Points<Wide> end = gather<Wide>(positions, tested.end + i);
  const Points<Wide> ball = gather<Wide>(positions, tested.ball + i);
  return relative_position(ball, start, end, Numbers::load(tested.reach + i), Numbers::load(tested.taper + i));
}

/// Sets the next checks of candidates that are tested together, whole vectors of them. Appends the indices of those
/// that overlap to `found`, each once.
void test_some(const Scene& scene, const State& state, ContactLists& lists, std::span<const int> awake,
               std::vector<int>& found) {
  Tested tested;
  collect(scene, state, lists, awake, tested);
  const Vector2* positions = state.position.data();
  double next_checks[kTestedTogether];
  for (std::size_t i = 0; i < awake.size(); i += Numbers::kWidth) {
    const RelativePosition<Wide> at = position_of(positions, tested, i);
    const LaneMask<Wide> overlaps = overlap(at);
    select(overlaps, Numbers(kNever), Numbers::load(tested.travel + i) + gap(at)).store(next_checks + i);
    for (unsigned bits = bits_of(overlaps); bits != 0; bits &= bits - 1) {
      const int index = awake[i + std::countr_zero(bits)];
      if (found.empty() || found.back() != index) {
        found.push_back(index);
      }
    }
  }
  double* of_all = lists.candidate_next_check_travel.data();
  for (std::size_t i = 0; i < awake.size(); ++i) {
    of_all[awake[i]] = next_checks[i];
  }
}

void test_awake(const Scene& scene, const State& state, ContactLists& lists, std::span<const int> awake,
                std::vector<int>& found) {
  for (std::size_t i = 0; i < awake.size(); i += kTestedTogether) {
    test_some(scene, state, lists, awake.subspan(i, std::min(kTestedTogether, awake.size() - i)), found);
  }
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {
namespace {

HWY_EXPORT(find_awake);
HWY_EXPORT(test_awake);

/// The candidates from `first` to `end` that overlap; sets the next checks of the others that are awake. The last of
/// them is repeated to fill a vector.
void find_overlaps_in(const Scene& scene, const State& state, ContactLists& lists, std::size_t first, std::size_t end,
                      ContactPart& part) {
  if (part.awake.size() < end - first + kCandidateBatch) {
    resize_with_room(part.awake, end - first + kCandidateBatch);
  }
  std::size_t count = find_awake_candidates(lists, first, end, part.awake.data());
  for (; count % kCandidateBatch != 0; ++count) {
    part.awake[count] = part.awake[count - 1];
  }
  part.found.clear();
  HWY_DYNAMIC_DISPATCH(test_awake)(scene, state, lists, std::span(part.awake).first(count), part.found);
}

}  // namespace

std::size_t find_awake_candidates(const ContactLists& lists, std::size_t first, std::size_t end, int* awake) {
  return HWY_DYNAMIC_DISPATCH(find_awake)(lists, first, end, awake);
}

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

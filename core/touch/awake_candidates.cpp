#include "touch/awake_candidates.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "touch/awake_candidates.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Bits of the awake candidates of a batch.
class AwakeBits {
 public:
  explicit AwakeBits(const ContactLists& lists)
      : next_checks_(lists.candidate_next_check_travel.data()),
        travels_(lists.group_travel.data()),
        groups_(lists.batch_group.empty() ? nullptr : lists.batch_group.data()) {}

  HWY_INLINE std::uint64_t of_batch(std::size_t batch) const {
    using Numbers = Lane<WideTag<double, kCandidateBatch>>;
    // In a search by buckets none sleeps.
    const Numbers travelled = groups_ == nullptr ? 0.0 : travels_[groups_[batch]];
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < kCandidateBatch; i += Numbers::kWidth) {
      const auto asleep = travelled < Numbers::load(next_checks_ + batch * kCandidateBatch + i);
      bits |= std::uint64_t{bits_of(!asleep)} << i;
    }
    return bits;
  }

 private:
  const double* const next_checks_;
  const double* const travels_;
  const int* const groups_;
};

// Few candidates are awake, in no predictable pattern: with a branch at every batch this takes three times as long.
std::size_t find_awake(const ContactLists& lists, std::size_t first, std::size_t end, int* places) {
  const AwakeBits awake(lists);
  const std::size_t end_batch = end / kCandidateBatch;
  std::size_t count = 0;
#if HWY_TARGET <= HWY_AVX3
  // The indices of a batch are stored whole, those of awake candidates first.
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

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(find_awake);

std::size_t find_awake_candidates(const ContactLists& lists, std::size_t first, std::size_t end, int* places) {
  return HWY_DYNAMIC_DISPATCH(find_awake)(lists, first, end, places);
}

}  // namespace cellcrush
#endif

// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_SIMD_LANE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_SIMD_LANE_INL_H_
#undef CELLCRUSH_SIMD_LANE_INL_H_
#else
#define CELLCRUSH_SIMD_LANE_INL_H_
#endif

#ifdef CELLCRUSH_ON_DEVICE
#include "simd/one_number-inl.h"
#else
#include <hwy/highway.h>
#endif

#include <bit>
#include <cstddef>
#include <cstdint>
#include <type_traits>

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// As many lanes as the registers of the target hold, at most kMost. One build has one lane everywhere; it shows that
/// the width does not change bits (tests/core/CMakeLists.txt, core_one_lane).
#ifdef CELLCRUSH_ONE_LANE
template <class T, std::size_t kMost>
using WideTag = hn::CappedTag<T, 1>;
#else
template <class T, std::size_t kMost>
using WideTag = hn::CappedTag<T, kMost>;
#endif

/// A mask over the lanes of Lane<D>.
template <class D>
struct LaneMask {
  hn::Mask<D> raw;

  /// The lowest bit is that of the first lane.
  friend HWY_INLINE unsigned bits_of(LaneMask a) {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(D(), a.raw, bytes);
    return bytes[0];
  }

  friend HWY_INLINE LaneMask operator&(LaneMask a, LaneMask b) { return {hn::And(a.raw, b.raw)}; }
  friend HWY_INLINE LaneMask operator|(LaneMask a, LaneMask b) { return {hn::Or(a.raw, b.raw)}; }
  friend HWY_INLINE LaneMask operator!(LaneMask a) { return {hn::Not(a.raw)}; }
  friend HWY_INLINE bool all(LaneMask a) { return hn::AllTrue(D(), a.raw); }
  friend HWY_INLINE bool any(LaneMask a) { return !hn::AllFalse(D(), a.raw); }
  friend HWY_INLINE bool none(LaneMask a) { return hn::AllFalse(D(), a.raw); }
};

/// One number for each of several elements, particles or pairs that are computed side by side: a vector register of
/// Highway's tag D with the operators of a number. A law written for Lane<D> holds at every width, including 1.
///
/// No operation is fused unless it is written as fma, fms or fnma; these round once where the target has the
/// instruction.
template <class D>
struct Lane {
  using Number = hn::TFromD<D>;
  using Raw = hn::Vec<D>;
  using Mask = LaneMask<D>;

  static constexpr std::size_t kWidth = hn::MaxLanes(D());

  Raw raw;

  Lane() = default;
  HWY_INLINE Lane(Raw vector) : raw(vector) {}
  HWY_INLINE Lane(Number value) : raw(hn::Set(D(), value)) {}

  /// Consecutive numbers of an array; those of a narrower type are converted.
  template <class T>
  static HWY_INLINE Lane load(const T* from) {
    if constexpr (std::is_same_v<T, Number>) {
      return hn::LoadU(D(), from);
    } else {
      return hn::PromoteTo(D(), hn::LoadU(hn::Rebind<T, D>(), from));
    }
  }

  template <class T>
  HWY_INLINE void store(T* to) const {
    if constexpr (std::is_same_v<T, Number>) {
      hn::StoreU(raw, D(), to);
    } else {
      const hn::Rebind<T, D> narrow;
      hn::StoreU(hn::DemoteTo(narrow, raw), narrow, to);
    }
  }

  friend HWY_INLINE Lane operator+(Lane a, Lane b) { return hn::Add(a.raw, b.raw); }
  friend HWY_INLINE Lane operator-(Lane a, Lane b) { return hn::Sub(a.raw, b.raw); }
  friend HWY_INLINE Lane operator*(Lane a, Lane b) { return hn::Mul(a.raw, b.raw); }
  friend HWY_INLINE Lane operator/(Lane a, Lane b) { return hn::Div(a.raw, b.raw); }
  friend HWY_INLINE Lane operator-(Lane a) { return hn::Neg(a.raw); }
  HWY_INLINE Lane& operator+=(Lane b) { return *this = *this + b; }
  HWY_INLINE Lane& operator-=(Lane b) { return *this = *this - b; }

  friend HWY_INLINE Mask operator<(Lane a, Lane b) { return {hn::Lt(a.raw, b.raw)}; }
  friend HWY_INLINE Mask operator<=(Lane a, Lane b) { return {hn::Le(a.raw, b.raw)}; }
  friend HWY_INLINE Mask operator>(Lane a, Lane b) { return {hn::Gt(a.raw, b.raw)}; }
  friend HWY_INLINE Mask operator>=(Lane a, Lane b) { return {hn::Ge(a.raw, b.raw)}; }
  friend HWY_INLINE Mask operator==(Lane a, Lane b) { return {hn::Eq(a.raw, b.raw)}; }
  friend HWY_INLINE Mask operator!=(Lane a, Lane b) { return {hn::Ne(a.raw, b.raw)}; }

  friend HWY_INLINE Lane fma(Lane a, Lane b, Lane c) { return hn::MulAdd(a.raw, b.raw, c.raw); }      ///< a b + c
  friend HWY_INLINE Lane fms(Lane a, Lane b, Lane c) { return hn::MulSub(a.raw, b.raw, c.raw); }      ///< a b - c
  friend HWY_INLINE Lane fnma(Lane a, Lane b, Lane c) { return hn::NegMulAdd(a.raw, b.raw, c.raw); }  ///< c - a b
  friend HWY_INLINE Lane min(Lane a, Lane b) { return hn::Min(a.raw, b.raw); }
  friend HWY_INLINE Lane max(Lane a, Lane b) { return hn::Max(a.raw, b.raw); }
  friend HWY_INLINE Lane abs(Lane a) { return hn::Abs(a.raw); }
  friend HWY_INLINE Lane sqrt(Lane a) { return hn::Sqrt(a.raw); }
  friend HWY_INLINE Lane select(Mask mask, Lane yes, Lane no) { return hn::IfThenElse(mask.raw, yes.raw, no.raw); }
  friend HWY_INLINE Number least_of_lanes(Lane a) { return hn::GetLane(hn::MinOfLanes(D(), a.raw)); }
  friend HWY_INLINE Number greatest_of_lanes(Lane a) { return hn::GetLane(hn::MaxOfLanes(D(), a.raw)); }
  /// `value` where the mask is set, else 0.
  friend HWY_INLINE Lane masked(Mask mask, Lane value) { return hn::IfThenElseZero(mask.raw, value.raw); }
};

/// Has the processor load a cache line that will be written.
HWY_INLINE void prefetch_to_change([[maybe_unused]] const void* at) {
#ifndef CELLCRUSH_ON_DEVICE
  __builtin_prefetch(at, 1);
#endif
}

/// Numbers of an array at given indices. Each is loaded on its own: a gather instruction takes up to three times as
/// long.
template <class D>
HWY_INLINE Lane<D> gather(const double* numbers, const int* indices) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (Lane<D>::kWidth > 1) {
    using Half = hn::Half<D>;
    return hn::Combine(D(), gather<Half>(numbers, indices + Lane<Half>::kWidth).raw,
                       gather<Half>(numbers, indices).raw);
  }
#endif
  if constexpr (Lane<D>::kWidth == 1) {
    return numbers[indices[0]];
  }
}

/// Writes first + lane for each lane that is set, and returns how many are set. For masks with few lanes set, this
/// takes less time than compressing a vector.
template <class D>
HWY_INLINE std::size_t write_set_lanes(LaneMask<D> mask, std::size_t first, int* to) {
  std::size_t count = 0;
  for (unsigned bits = bits_of(mask); bits != 0; bits &= bits - 1) {
    to[count++] = static_cast<int>(first) + std::countr_zero(bits);
  }
  return count;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_SIMD_LANE_INL_H_

// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_SIMD_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_SIMD_LANES_INL_H_
#undef CELLCRUSH_SIMD_LANES_INL_H_
#else
#define CELLCRUSH_SIMD_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>
#include <cstddef>
#include <cstdint>

#include "cellcrush/vector.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Points or vectors in the plane, one a lane.
template <class D>
struct Points {
  hn::Vec<D> x;
  hn::Vec<D> y;
};

/// Consecutive points of an array.
template <class D>
HWY_INLINE Points<D> load_points(D d, const Vector2* points) {
  const double* values = points->data();
  Points<D> loaded;
  if constexpr (hn::MaxLanes(D()) == 1) {
    loaded.x = hn::Set(d, values[0]);
    loaded.y = hn::Set(d, values[1]);
  } else {
    hn::LoadInterleaved2(d, values, loaded.x, loaded.y);
  }
  return loaded;
}

template <class D>
HWY_INLINE void store_points(D d, const Points<D>& points, Vector2* to) {
  double* values = to->data();
  if constexpr (hn::MaxLanes(D()) == 1) {
    values[0] = hn::GetLane(points.x);
    values[1] = hn::GetLane(points.y);
#if HWY_TARGET <= HWY_AVX3
  } else if constexpr (hn::MaxLanes(D()) == 8) {
    // Two permutations in place of six shuffles; Highway has no function for them before its version 1.1.
    const __m512i low = _mm512_setr_epi64(0, 8, 1, 9, 2, 10, 3, 11);
    const __m512i high = _mm512_setr_epi64(4, 12, 5, 13, 6, 14, 7, 15);
    _mm512_storeu_pd(values, _mm512_permutex2var_pd(points.x.raw, low, points.y.raw));
    _mm512_storeu_pd(values + 8, _mm512_permutex2var_pd(points.x.raw, high, points.y.raw));
#endif
  } else {
    hn::StoreInterleaved2(points.x, points.y, d, values);
  }
}

/// Consecutive numbers of an array, in the lanes' precision.
template <class D>
HWY_INLINE hn::Vec<D> load_as(D d, const double* values) {
  return hn::LoadU(d, values);
}
template <class D>
HWY_INLINE hn::Vec<D> load_as(D d, const float* values) {
  return hn::PromoteTo(d, hn::LoadU(hn::Rebind<float, D>(), values));
}

/// Stores numbers in the array's precision.
template <class D>
HWY_INLINE void store_as(D d, hn::Vec<D> values, double* to) {
  hn::StoreU(values, d, to);
}
template <class D>
HWY_INLINE void store_as(D, hn::Vec<D> values, float* to) {
  const hn::Rebind<float, D> narrow;
  hn::StoreU(hn::DemoteTo(narrow, values), narrow, to);
}

/// Numbers of an array, of indices in memory. Each is loaded by itself: a gather instruction takes up to three times as long.
template <class D>
HWY_INLINE hn::Vec<D> gather_numbers(D d, const double* numbers, const int* indices) {
  constexpr std::size_t kLanes = hn::MaxLanes(D());
#if HWY_TARGET != HWY_SCALAR
  if constexpr (kLanes > 1) {
    const hn::Half<D> half;
    return hn::Combine(d, gather_numbers(half, numbers, indices + kLanes / 2), gather_numbers(half, numbers, indices));
  }
#endif
  if constexpr (kLanes == 1) {
    return hn::Set(d, numbers[indices[0]]);
  }
}

#if HWY_TARGET != HWY_SCALAR
/// Points that lie one after the other, the low half first.
template <class D, class Half>
HWY_INLINE Points<D> part_points(D d, Half low, Half high) {
  return {hn::ConcatEven(d, high, low), hn::ConcatOdd(d, high, low)};
}
#endif

/// Half as many points of an array as the lanes, of indices in memory, one after the other.
template <class D>
HWY_INLINE hn::Vec<D> load_half(D d, const Vector2* points, const int* indices) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (hn::MaxLanes(D()) > 2) {
    const hn::Half<D> half;
    constexpr std::size_t kNext = hn::MaxLanes(D()) / 4;
    return hn::Combine(d, load_half(half, points, indices + kNext), load_half(half, points, indices));
  }
#endif
  if constexpr (hn::MaxLanes(D()) == 2) {
    return hn::LoadU(d, points[indices[0]].data());
  }
}

/// Points of an array, of indices in memory: they are loaded whole and parted then.
template <class D>
HWY_INLINE Points<D> gather_points(D d, const Vector2* points, const int* indices) {
  if constexpr (hn::MaxLanes(D()) == 1) {
    const double* values = points[indices[0]].data();
    return {hn::Set(d, values[0]), hn::Set(d, values[1])};
  }
#if HWY_TARGET != HWY_SCALAR
  if constexpr (hn::MaxLanes(D()) > 1) {
    constexpr std::size_t kHalf = hn::MaxLanes(D()) / 2;
    return part_points(d, load_half(d, points, indices), load_half(d, points, indices + kHalf));
  }
#endif
}

/// Bits of the lanes that are set.
template <class D>
HWY_INLINE unsigned bits_of(D d, hn::Mask<D> mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(d, mask, bits);
  return bits[0];
}

/// Writes the numbers of the lanes that are set, counted from `first`; returns how many there are. For masks of which few
/// are set: one by one, which takes less time than a vector compressed.
template <class D>
HWY_INLINE std::size_t write_set_lanes(D d, hn::Mask<D> mask, std::size_t first, int* numbers) {
  std::size_t count = 0;
  for (unsigned bits = bits_of(d, mask); bits != 0; bits &= bits - 1) {
    numbers[count++] = static_cast<int>(first) + std::countr_zero(bits);
  }
  return count;
}

template <class D>
HWY_INLINE hn::Vec<D> cross(const Points<D>& a, const Points<D>& b) {
  return hn::MulSub(a.x, b.y, hn::Mul(a.y, b.x));
}

template <class D>
HWY_INLINE hn::Vec<D> dot(const Points<D>& a, const Points<D>& b) {
  return hn::MulAdd(a.x, b.x, hn::Mul(a.y, b.y));
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_SIMD_LANES_INL_H_

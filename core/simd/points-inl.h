// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_SIMD_POINTS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_SIMD_POINTS_INL_H_
#undef CELLCRUSH_SIMD_POINTS_INL_H_
#else
#define CELLCRUSH_SIMD_POINTS_INL_H_
#endif

#include <cstddef>

#include "cellcrush/vector.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Points or vectors in the plane, one per lane.
template <class D>
struct Points {
  Lane<D> x;
  Lane<D> y;

  /// Consecutive points of an array.
  static HWY_INLINE Points load(const Vector2* from) {
    const double* values = from->data();
    Points points;
    if constexpr (Lane<D>::kWidth == 1) {
      points.x = values[0];
      points.y = values[1];
    } else {
      hn::LoadInterleaved2(D(), values, points.x.raw, points.y.raw);
    }
    return points;
  }

  HWY_INLINE void store(Vector2* to) const {
    double* values = to->data();
    if constexpr (Lane<D>::kWidth == 1) {
      values[0] = hn::GetLane(x.raw);
      values[1] = hn::GetLane(y.raw);
#if HWY_TARGET <= HWY_AVX3
    } else if constexpr (Lane<D>::kWidth == 8) {
      // Two permutations instead of six shuffles; before version 1.1 Highway has no function for this.
      const __m512i low = _mm512_setr_epi64(0, 8, 1, 9, 2, 10, 3, 11);
      const __m512i high = _mm512_setr_epi64(4, 12, 5, 13, 6, 14, 7, 15);
      _mm512_storeu_pd(values, _mm512_permutex2var_pd(x.raw.raw, low, y.raw.raw));
      _mm512_storeu_pd(values + 8, _mm512_permutex2var_pd(x.raw.raw, high, y.raw.raw));
#endif
    } else {
      hn::StoreInterleaved2(x.raw, y.raw, D(), values);
    }
  }

  friend HWY_INLINE Points operator+(const Points& a, const Points& b) { return {a.x + b.x, a.y + b.y}; }
  friend HWY_INLINE Points operator-(const Points& a, const Points& b) { return {a.x - b.x, a.y - b.y}; }
  friend HWY_INLINE Points operator-(const Points& a) { return {-a.x, -a.y}; }
  friend HWY_INLINE Points operator*(Lane<D> factor, const Points& a) { return {factor * a.x, factor * a.y}; }
  friend HWY_INLINE Points fma(Lane<D> factor, const Points& a, const Points& b) {
    return {fma(factor, a.x, b.x), fma(factor, a.y, b.y)};
  }
  friend HWY_INLINE Points fms(Lane<D> factor, const Points& a, const Points& b) {
    return {fms(factor, a.x, b.x), fms(factor, a.y, b.y)};
  }
  /// Separately for x and y.
  friend HWY_INLINE Points min(const Points& a, const Points& b) { return {min(a.x, b.x), min(a.y, b.y)}; }
  friend HWY_INLINE Points max(const Points& a, const Points& b) { return {max(a.x, b.x), max(a.y, b.y)}; }
  friend HWY_INLINE Points select(LaneMask<D> mask, const Points& yes, const Points& no) {
    return {select(mask, yes.x, no.x), select(mask, yes.y, no.y)};
  }
  friend HWY_INLINE Lane<D> dot(const Points& a, const Points& b) { return fma(a.x, b.x, a.y * b.y); }
  /// Positive where `b` points counter-clockwise of `a`.
  friend HWY_INLINE Lane<D> cross(const Points& a, const Points& b) { return fms(a.x, b.y, a.y * b.x); }
};

#if HWY_TARGET != HWY_SCALAR
/// Separates points that lie one after the other, the low half first, into x and y.
template <class D>
HWY_INLINE Points<D> separate(hn::Vec<D> low, hn::Vec<D> high) {
  return {hn::ConcatEven(D(), high, low), hn::ConcatOdd(D(), high, low)};
}

/// Half as many points of an array as lanes, at given indices, one after the other.
template <class D>
HWY_INLINE hn::Vec<D> gather_half(const Vector2* points, const int* indices) {
  if constexpr (hn::MaxLanes(D()) > 2) {
    using Half = hn::Half<D>;
    constexpr std::size_t kNext = hn::MaxLanes(D()) / 4;
    return hn::Combine(D(), gather_half<Half>(points, indices + kNext), gather_half<Half>(points, indices));
  }
  if constexpr (hn::MaxLanes(D()) == 2) {
    return hn::LoadU(D(), points[indices[0]].data());
  }
}
#endif

/// Points of an array at given indices: each is loaded whole, then x and y are separated.
template <class D>
HWY_INLINE Points<D> gather(const Vector2* points, const int* indices) {
  if constexpr (Lane<D>::kWidth == 1) {
    return Points<D>::load(&points[indices[0]]);
  }
#if HWY_TARGET != HWY_SCALAR
  if constexpr (Lane<D>::kWidth > 1) {
    constexpr std::size_t kHalf = Lane<D>::kWidth / 2;
    return separate<D>(gather_half<D>(points, indices), gather_half<D>(points, indices + kHalf));
  }
#endif
}

/// Two arrays of points and one of numbers at the same indices, for half of the lanes at a time. Few addresses are then
/// in use at once, so they stay in registers.
template <class D>
HWY_INLINE void gather_together(const Vector2* a, const Vector2* b, const double* c, const int* indices,
                                Points<D>& of_a, Points<D>& of_b, Lane<D>& of_c) {
#if HWY_TARGET != HWY_SCALAR
  if constexpr (Lane<D>::kWidth > 1) {
    using Half = hn::Half<D>;
    const int* const next = indices + Lane<Half>::kWidth;
    const auto low_a = gather_half<D>(a, indices);
    const auto low_b = gather_half<D>(b, indices);
    const auto low_c = gather<Half>(c, indices);
    const auto high_a = gather_half<D>(a, next);
    const auto high_b = gather_half<D>(b, next);
    const auto high_c = gather<Half>(c, next);
    of_a = separate<D>(low_a, high_a);
    of_b = separate<D>(low_b, high_b);
    of_c = hn::Combine(D(), high_c.raw, low_c.raw);
    return;
  }
#endif
  of_a = gather<D>(a, indices);
  of_b = gather<D>(b, indices);
  of_c = gather<D>(c, indices);
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_SIMD_POINTS_INL_H_

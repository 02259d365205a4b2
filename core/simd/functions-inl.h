// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_SIMD_FUNCTIONS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_SIMD_FUNCTIONS_INL_H_
#undef CELLCRUSH_SIMD_FUNCTIONS_INL_H_
#else
#define CELLCRUSH_SIMD_FUNCTIONS_INL_H_
#endif

#include <hwy/contrib/math/math-inl.h>

#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// To a few units in the last place.
template <class D>
HWY_INLINE Lane<D> exponential(Lane<D> x) {
  return hn::Exp(D(), x.raw);
}

/// Of numbers from the smallest normal one on; to a few units in the last place.
template <class D>
HWY_INLINE Lane<D> logarithm(Lane<D> x) {
  return hn::Log(D(), x.raw);
}

/// x^n of such numbers.
template <class D>
HWY_INLINE Lane<D> power(Lane<D> x, Lane<D> n) {
  return exponential(n * logarithm(x));
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_SIMD_FUNCTIONS_INL_H_

// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_SIMD_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_SIMD_LANES_INL_H_
#undef CELLCRUSH_SIMD_LANES_INL_H_
#else
#define CELLCRUSH_SIMD_LANES_INL_H_
#endif

#include <hwy/highway.h>

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

/// Indices for gathering doubles, from ints.
template <class D>
HWY_INLINE hn::Vec<hn::RebindToSigned<D>> load_indices(D, const int* indices) {
  const hn::RebindToSigned<D> wide;
  const hn::Rebind<std::int32_t, D> narrow;
  return hn::PromoteTo(wide, hn::LoadU(narrow, indices));
}

/// Points of an array, at any places.
template <class D>
HWY_INLINE Points<D> gather_points(D d, const Vector2* points, hn::Vec<hn::RebindToSigned<D>> indices) {
  const double* values = points->data();
  const auto twice = hn::Add(indices, indices);
  return {hn::GatherIndex(d, values, twice), hn::GatherIndex(d, values + 1, twice)};
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

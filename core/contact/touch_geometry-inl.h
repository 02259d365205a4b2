// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_CONTACT_TOUCH_GEOMETRY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_CONTACT_TOUCH_GEOMETRY_INL_H_
#undef CELLCRUSH_CONTACT_TOUCH_GEOMETRY_INL_H_
#else
#define CELLCRUSH_CONTACT_TOUCH_GEOMETRY_INL_H_
#endif

#include <algorithm>
#include <cmath>

#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// See Projection of contact/touch/force_laws.h.
template <class Number>
struct Offset {
  Number along;  ///< mm from the segment's start to the foot, 0 to length
  Number x;      ///< from the foot to the point
  Number y;
};

/// Projects points at (x, y) from the start of a segment, one point or one per lane. No operation is fused, so that all
/// widths round alike.
template <class Number>
HWY_INLINE Offset<Number> project_clamped(Number x, Number y, Number axis_x, Number axis_y, Number length) {
  using std::max;
  using std::min;
  const Number ahead = x * axis_x + y * axis_y;
  const Number along = min(max(ahead, Number(0.0)), length);
  return {along, x - along * axis_x, y - along * axis_y};
}

/// Share that the growth of a segment at its end has in that at the foot at `share`; that at its start has the rest
/// (E8d). The slope is 0 at both nodes, so that a ball that slides over a node feels no jump.
template <class Number>
HWY_INLINE Number share_of_end(Number share) {
  return share * share * (Number(3.0) - Number(2.0) * share);
}

/// Viscous force c dD/dt of a contact that deepens at `rate` (mm/s): c = 2 damping_ratio sqrt(k m), with the effective
/// mass m = 1 / inverse_mass (Eq. 43, E9). For one contact, or for one per lane.
template <class Number>
HWY_INLINE Number viscous_force(double stiffness, double damping_ratio, Number inverse_mass, Number rate) {
  using std::sqrt;
  return 2.0 * damping_ratio * sqrt(stiffness / inverse_mass) * rate;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_CONTACT_TOUCH_GEOMETRY_INL_H_

// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_TOUCH_VISCOUS_FORCE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_TOUCH_VISCOUS_FORCE_INL_H_
#undef CELLCRUSH_TOUCH_VISCOUS_FORCE_INL_H_
#else
#define CELLCRUSH_TOUCH_VISCOUS_FORCE_INL_H_
#endif

#include <hwy/highway.h>

#include <cmath>

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Viscous force c dD/dt of a contact that deepens at `rate` (mm/s): c = 2 damping_ratio sqrt(k m), with the effective
/// mass m = 1 / inverse_mass (Eq. 43, E9). For one contact, or for one per lane.
template <class Number>
HWY_INLINE Number viscous_force(double stiffness, double damping_ratio, Number inverse_mass, Number rate) {
  using std::sqrt;
  return 2.0 * damping_ratio * sqrt(stiffness / inverse_mass) * rate;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_TOUCH_VISCOUS_FORCE_INL_H_

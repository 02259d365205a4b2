// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_CONTACT_TOUCH_OVERLAP_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_CONTACT_TOUCH_OVERLAP_INL_H_
#undef CELLCRUSH_CONTACT_TOUCH_OVERLAP_INL_H_
#else
#define CELLCRUSH_CONTACT_TOUCH_OVERLAP_INL_H_
#endif

#include <algorithm>

#include "contact/start_overlaps.h"
#include "contact/touch_geometry-inl.h"
#include "simd/points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Distance at which a ball and a segment touch with the current thickness, mm (E8d).
struct GrownReach {
  double at_start;
  double taper;  ///< what it is more at the end of the segment
};

/// `before`: with the thickness before loading.
HWY_INLINE GrownReach grown_reach(const Scene& scene, const State& state, int ball, int segment, double before) {
  const double of_ball = state.radius_growth[ball];
  const double of_start = state.radius_growth[scene.elements[segment].start];
  const double of_end = state.radius_growth[scene.elements[segment].end];
  if (!(of_ball + of_start + of_end > 0.0)) {
    return {before, 0.0};
  }
  const double most = most_reach_now(scene, state, ball, segment);
  const double at_start = std::min(before + of_ball + of_start, most);
  return {at_start, std::min(before + of_ball + of_end, most) - at_start};
}

/// Balls relative to segments. w points from the start of the segment to the ball, u is the segment.
template <class D>
struct RelativePosition {
  Lane<D> reach;
  Lane<D> taper;
  Lane<D> squared_distance;  // w.w, from the start
  Lane<D> foot;              // w.u
  Lane<D> squared_length;    // u.u
};

/// Of balls, and of segments from `start` to `end`.
template <class D>
HWY_INLINE RelativePosition<D> relative_position(const Points<D>& ball, const Points<D>& start, const Points<D>& end,
                                                 Lane<D> reach, Lane<D> taper) {
  const Points<D> u = end - start;
  const Points<D> w = ball - start;
  return {reach, taper, dot(w, w), dot(w, u), dot(u, u)};
}

/// Lanes whose ball is nearer to its segment than their reach (E8, E8a): to its line if the ball is beside it,
/// otherwise to the nearer end. No division is needed: the squared distance from the line is w.w - (w.u)^2 / u.u.
/// Round-off decides for pairs that just touch. A lane therefore never depends on the others: threads group them
/// differently.
template <class D>
HWY_INLINE LaneMask<D> overlap(const RelativePosition<D>& at) {
  const Lane<D> zero = 0.0;
  const auto beyond_start = fnma(at.reach, at.reach, at.squared_distance);  // w.w - reach^2
  auto beyond_end = beyond_start - (at.foot + at.foot) + at.squared_length;
  auto beyond_foot = beyond_start;
  const auto is_even = at.taper == zero;
  if (HWY_UNLIKELY(!all(is_even))) {
    const auto reach_at_end = at.reach + at.taper;
    const auto from_end = at.squared_distance - (at.foot + at.foot) + at.squared_length;
    const auto share = min(max(at.foot, zero), at.squared_length) / at.squared_length;
    const auto reach_at_foot = fma(at.taper, share_of_end(share), at.reach);
    beyond_end = select(is_even, beyond_end, fnma(reach_at_end, reach_at_end, from_end));
    beyond_foot = select(is_even, beyond_foot, fnma(reach_at_foot, reach_at_foot, at.squared_distance));
  }
  const auto beside = (at.foot > zero) & (at.foot < at.squared_length);
  const auto near_line = beyond_foot * at.squared_length < at.foot * at.foot;
  return (beyond_start < zero) | (beyond_end < zero) | (beside & near_line);
}

/// Gaps, mm: distances minus the greatest reach along the segment.
template <class D>
HWY_INLINE Lane<D> gap(const RelativePosition<D>& at) {
  const Lane<D> zero = 0.0;
  const auto share = min(max(at.foot, zero), at.squared_length) / at.squared_length;
  // w.w - 2 s w.u + s^2 u.u
  const auto squared = fnma(share, fnma(share, at.squared_length, at.foot + at.foot), at.squared_distance);
  return sqrt(max(squared, zero)) - (at.reach + max(at.taper, zero));
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_CONTACT_TOUCH_OVERLAP_INL_H_

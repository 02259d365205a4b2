// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_BEAM_DEFORMATION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_BEAM_DEFORMATION_INL_H_
#undef CELLCRUSH_BEAM_DEFORMATION_INL_H_
#else
#define CELLCRUSH_BEAM_DEFORMATION_INL_H_
#endif

#include <numbers>

#include "simd/lane-inl.h"
#include "simd/points-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Sine below which the rotation of an axis over a step is a series. The first omitted term is below 1e-17 of the
/// angle.
inline constexpr double kSmallTurn = 0.02;

/// Angle in (-pi, pi] of a sine and a cosine, to 1e-15 of it. It has the same bits on every target and device,
/// which the arc tangent of the C library has not.
template <class D>
HWY_INLINE Lane<D> angle_of(Lane<D> sine, Lane<D> cosine) {
  const Lane<D> one = 1;
  // Tangents of half, a quarter and an eighth of the angle to the nearer half axis.
  const auto halve = [&](Lane<D> tangent) HWY_ATTR { return tangent / (one + sqrt(fma(tangent, tangent, one))); };
  const Lane<D> tangent = halve(halve(sine / (one + abs(cosine))));
  const Lane<D> square = tangent * tangent;  // at most 0.04
  Lane<D> series = -1.0 / 23.0;
  for (int n = 21; n >= 3; n -= 2) {
    series = fma(square, series, (n % 4 == 1 ? 1.0 : -1.0) / n);
  }
  const Lane<D> near = Lane<D>(8) * fma(tangent * square, series, tangent);
  const Lane<D> half_turn = select(sine < Lane<D>(0), Lane<D>(-std::numbers::pi), Lane<D>(std::numbers::pi));
  return select(cosine < Lane<D>(0), half_turn - near, near);
}

/// Angle phi from the unit vector `from` to the unit vector `to`, positive counter-clockwise, in (-pi, pi] (Eq. 9, E3).
/// Exact to round-off for any size and both signs.
///
/// Deviation from Eq. 9: the arc cosine of the dot product loses the sign, and is 0 below 2e-8 rad. The sine is the
/// cross product. Its inverse is a series where it is small, as in every step of a sound run.
template <class D>
HWY_INLINE Lane<D> turn_between(const Points<D>& from, const Points<D>& to) {
  const Lane<D> sine = cross(from, to);
  const Lane<D> cosine = dot(from, to);
  const Lane<D> square = sine * sine;
  Lane<D> series = fma(square, 105.0 / 3456.0, 15.0 / 336.0);
  series = fma(square, series, 3.0 / 40.0);
  series = fma(square, series, 1.0 / 6.0);
  const Lane<D> turn = fma(sine * square, series, sine);
  const LaneMask<D> is_small = (abs(sine) < kSmallTurn) & (cosine > 0);
  if (HWY_LIKELY(all(is_small))) {
    return turn;
  }
  return select(is_small, turn, angle_of(sine, cosine));
}

/// Deformation of an element over a step: its motion without the rigid part (section 2.3.1, E4).
template <class D>
struct Deformation {
  Lane<D> stretch;         ///< Delta = l - l_a, mm (Eq. 15, E4)
  Lane<D> rotation_start;  ///< theta_1, rad (Eq. 14, E4)
  Lane<D> rotation_end;    ///< theta_2, rad
  Lane<D> length;          ///< l, mm
  Lane<D> inverse_length;  ///< 1/mm
  Points<D> axis;          ///< e, unit vector from the start node to the end node (e_t of the paper)
};

/// l and 1 / l from l squared. Where the length differs little from the previous one, a series from its inverse gives
/// all digits and avoids the division, which is slow. Otherwise it is divided.
template <class D>
HWY_INLINE void invert_length(Lane<D> square, Lane<D> previous_inverse, Deformation<D>& deformation) {
  constexpr double kSmallMiss = 2e-3;  // the first omitted terms are below 1e-17
  const Lane<D> one = 1;
  const Lane<D> half = 0.5;
  const Lane<D> miss = fnma(square, previous_inverse * previous_inverse, one);
  const Lane<D> series = fma(miss, fma(miss, 0.375, half), one);
  const Lane<D> near = previous_inverse * series;
  const Lane<D> left = fnma(square, near * near, one);
  deformation.inverse_length = fma(near * half, left, near);
  deformation.length = square * deformation.inverse_length;
  const LaneMask<D> is_small = abs(miss) < kSmallMiss;
  if (HWY_UNLIKELY(!all(is_small))) {
    const Lane<D> length = sqrt(square);
    deformation.length = select(is_small, deformation.length, length);
    deformation.inverse_length = select(is_small, deformation.inverse_length, one / length);
  }
}

/// Reverse rigid motion of an element: subtracts the translation and the rotation of its axis from the motion of its
/// nodes (Eq. 8-15, E3, E4). `span` points from the start node to the end node now. The previous axis and length are
/// those at the start of the step. The turns are the rotation increments of the nodes over the step.
template <class D>
HWY_INLINE Deformation<D> reverse_motion(const Points<D>& span, const Points<D>& previous_axis, Lane<D> previous_length,
                                         Lane<D> previous_inverse, Lane<D> turn_start, Lane<D> turn_end) {
  Deformation<D> deformation;
  invert_length(dot(span, span), previous_inverse, deformation);
  deformation.axis = deformation.inverse_length * span;
  const Lane<D> rigid_turn = turn_between(previous_axis, deformation.axis);
  deformation.stretch = deformation.length - previous_length;
  deformation.rotation_start = turn_start - rigid_turn;
  deformation.rotation_end = turn_end - rigid_turn;
  return deformation;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_BEAM_DEFORMATION_INL_H_

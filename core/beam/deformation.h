#pragma once

#include <cmath>

#include "cellcrush/vector.h"

namespace cellcrush {

/// Sine up to which the turn of a step is a series; the first term left out is below 1e-17 of the angle.
inline constexpr double kSmallTurn = 0.02;

/// Angle by which the unit vector `from` must turn to point along the unit vector `to`, counter-clockwise positive, in
/// (-pi, pi]. Exact to round-off for increments of any size, both signs.
///
/// Deviation from Eq. 9: the arc cosine of the dot product loses the sign, and is 0 below 2e-8 rad. The sine is the cross
/// product; its inverse is a series where it is small, as it is in every step of a sound run.
inline double turn_between(const Vector2& from, const Vector2& to) {
  const double sine = cross(from, to);
  const double cosine = from.dot(to);
  if (std::abs(sine) < kSmallTurn && cosine > 0.0) {
    const double square = sine * sine;
    return sine *
           (1.0 + square * (1.0 / 6.0 + square * (3.0 / 40.0 + square * (15.0 / 336.0 + square * 105.0 / 3456.0))));
  }
  return std::atan2(sine, cosine);
}

/// What is left of an element's motion over a step once its rigid part is taken out (section 2.3.1).
struct Deformation {
  double stretch;         ///< Delta = l - l_a, mm (Eq. 15)
  double rotation_start;  ///< theta_1, rad (Eq. 14)
  double rotation_end;    ///< theta_2, rad
  double length;          ///< l, mm
  Vector2 axis;           ///< e_t, unit vector from the start node to the end node
};

/// Reverse rigid motion of an element: translation and rotation by the turn of its axis are taken out of the motion of its
/// nodes (Eq. 8-15). `span` points from the start node to the end node now; `previous_axis` and `previous_length` are those
/// of the step before; the turns are the nodes' rotation increments over the step.
inline Deformation reverse_motion(const Vector2& span, const Vector2& previous_axis, double previous_length,
                                  double turn_start, double turn_end) {
  const double length = span.norm();
  const Vector2 axis = span / length;
  const double rigid_turn = turn_between(previous_axis, axis);
  return {length - previous_length, turn_start - rigid_turn, turn_end - rigid_turn, length, axis};
}

}  // namespace cellcrush

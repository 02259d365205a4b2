#pragma once

#include "cellcrush/scene.h"

namespace cellcrush::scenes {

// The laws that run, on the SIMD target in use, for one element.

/// See turn_between in beam/deformation-inl.h.
double turn_between(const Vector2& from, const Vector2& to);

/// See Deformation in beam/deformation-inl.h.
struct ElementDeformation {
  double stretch;
  double rotation_start;
  double rotation_end;
};
ElementDeformation reverse_motion(const Vector2& span, const Vector2& previous_axis, double previous_length,
                                  double turn_start, double turn_end);

/// Share of the modulus of an element of constant volume, alone or in a pair, with a factor on its rotary inertia; see
/// CrossSection in beam/cross_section-inl.h.
double modulus_share(double length, double undeformed, double thickness, bool in_pairs, double rotary);

}  // namespace cellcrush::scenes

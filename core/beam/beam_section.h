#pragma once

#include <algorithm>

#include "cellcrush/scene.h"

namespace cellcrush {

/// The section of an element as it is now, in a wall that may have been squashed short.
struct BeamSection {
  double thickness;  ///< h, mm
  double area;       ///< mm^2
  double volume;     ///< mm^3, what stress works on
  double stiffness;  ///< share of Young's modulus that is left
};

/// Length over undeformed length below which the modulus is bounded.
inline constexpr double kShortenedTo = 0.95;

/// Share of Young's modulus with which an element squashed from `undeformed` to `length` vibrates no faster than at
/// kShortenedTo: A / l and I / l grow with the shortening, at constant volume with its square, and the shear they cause by
/// 1 + 4 gamma^2 / l^2 (E11). Such an element flows: its force is the yield stress's, and what its modulus stores is a small
/// part of its plastic work.
inline double bounded_stiffness(double length, double undeformed, double thickness, bool constant_area) {
  const double bound = kShortenedTo * undeformed;
  if (length >= bound) {
    return 1.0;
  }
  const double four_gyration_squared = thickness * thickness / 3.0;
  const double ratio = length / bound;
  return (constant_area ? ratio : ratio * ratio) * (1.0 + four_gyration_squared / (bound * bound)) /
         (1.0 + four_gyration_squared / (length * length));
}

/// Section of an element of a wall, of the given length. Plastic flow keeps a wall's volume: the area is V_0 / l, the thickness in the
/// plane being kept. With constant area, as in the paper, a wall under its yield force would shorten without end, one element
/// of it before the others.
inline BeamSection section_of(const Scene& scene, int wall, double length) {
  const double thickness = scene.walls.thickness[wall];
  const double undeformed = scene.walls.undeformed_length[wall];
  const double area = scene.depth * thickness;
  const double stiffness = bounded_stiffness(length, undeformed, thickness, scene.constant_area);
  if (scene.constant_area) {
    return {thickness, area, area * length, stiffness};
  }
  const double volume = area * undeformed;
  return {thickness, volume / length, volume, stiffness};
}

}  // namespace cellcrush

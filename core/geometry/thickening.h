#pragma once

#include <algorithm>
#include <cstddef>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

// The thickness of squashed walls (E5f). Plastic flow keeps the volume of a wall that shortens. In plane strain its
// depth cannot grow, so its thickness does; in plane stress both grow alike. Bending and contact use the current
// thickness. The growth of half of it is a function of the length of the element alone (beam/cross_section-inl.h). In
// contact, a ball inside a wall grows by the mean of both its elements, and a joint keeps its radius. Along a segment
// the growth varies smoothly from the ball at one node to that at the other (E8d).

/// l / l_0 below which an element is squashed, so that its modulus is reduced (E5c).
inline constexpr double kSquashedStretch = 0.95;

/// What the growth of h / h_0 leaves out, so that walls that are hardly squashed need no further work (E5f).
inline constexpr double kGrowthLeftOut = 0.1;

/// What the radius of a ball has grown by, mm.
inline double growth_of_ball(const State& state, int ball) {
  return state.radius_growth.empty() ? 0.0 : state.radius_growth[ball];
}

/// Current radius of a ball, mm.
inline double radius_now(const Scene& scene, const State& state, int ball) {
  return scene.radius[ball] + growth_of_ball(state, ball);
}

/// Half of the current thickness of a segment where it is thickest, mm.
inline double half_thickness_now(const Scene& scene, const State& state, int segment) {
  const Element& element = scene.elements[segment];
  return 0.5 * element.thickness + std::max(growth_of_ball(state, element.start), growth_of_ball(state, element.end));
}

/// Distance at which a ball and a segment touch, mm (E8, E8a, E8d): with the foot at `share` of the segment, and where
/// that is greatest.
double reach_at(const Scene& scene, const State& state, int ball, int segment, double share);
double greatest_reach(const Scene& scene, const State& state, int ball, int segment);

/// What the reach of any pair can have grown by in the newest step, mm: of balls and segments of the bands from `first`
/// to `end`.
double growth_of_reach(const Scene& scene, const State& state, std::size_t first, std::size_t end);

}  // namespace cellcrush

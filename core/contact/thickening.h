#pragma once

#include <algorithm>
#include <cstddef>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "cellcrush/vector.h"

namespace cellcrush {

// The thickness of squashed walls (E5f). Plastic flow keeps the volume of a wall that shortens. In plane strain its
// depth cannot grow, so its thickness does; in plane stress both grow alike. Bending and contact use the current
// thickness. The growth of half of it is a function of one length alone (beam/cross_section-inl.h): in bending of L, as
// all of the section; in contact of l, because the forces of contacts are the gradient of an energy of places. In
// contact, a ball inside a wall grows by the mean of both its elements, and a joint keeps its radius. Along a segment
// the growth varies smoothly from the ball at one node to that at the other (E8d).

/// L / l_0 below which an element is squashed, so that its modulus is reduced (E5c).
inline constexpr double kSquashedStretch = 0.95;

/// What the growth of h / h_0 leaves out, so that walls that are hardly squashed need no further work (E5f).
inline constexpr double kGrowthLeftOut = 0.1;

/// What the radius of a ball has grown by, mm.
template <class S>
constexpr double growth_of_ball(const S& state, int ball) {
  return state.radius_growth.empty() ? 0.0 : state.radius_growth[ball];
}

/// Current radius of a ball, mm.
template <class OfScene, class S>
constexpr double radius_now(const OfScene& scene, const S& state, int ball) {
  return scene.radius[ball] + growth_of_ball(state, ball);
}

/// Half of the current thickness of a segment where it is thickest, mm.
template <class OfScene, class S>
constexpr double half_thickness_now(const OfScene& scene, const S& state, int segment) {
  const Element& element = scene.elements[segment];
  return 0.5 * element.thickness + std::max(growth_of_ball(state, element.start), growth_of_ball(state, element.end));
}

/// Distance at which a ball and a segment touch, mm (E8, E8a, E8d, E8f): with the foot at `share` of the segment, and
/// the greatest anywhere on it once they have parted.
double reach_at(const Scene& scene, const State& state, int ball, int segment, double share);
double greatest_reach(const Scene& scene, const State& state, int ball, int segment);

/// What the reach of any pair can have grown by in the newest step, mm: of balls and segments of the bands from `first`
/// to `end`.
double growth_of_reach(const Scene& scene, const State& state, std::size_t first, std::size_t end);

// A squashed wall that grows thicker does work on what touches it (E8d). The stored energy of a contact is a function
// of its reach; the reach follows the lengths of the elements that have grown, and the place of the foot. Its
// derivatives are forces. The viscous force and friction have none.

/// Adds the forces on the ends of the elements with which a ball grows. `force`, N, presses against its radius.
/// REQUIRES: the ball has grown.
void push_elements_apart(const Scene& scene, State& state, int ball, double force);

/// Where a ball touches a segment that has grown.
struct GrownTouch {
  int ball;
  int segment;
  double share;   ///< s of the foot
  double offset;  ///< mm, of the ball to the left of the segment; matters only where 0 < share < 1
  double force;   ///< N, of the contact, elastic
};

/// Adds all such forces of a touch: on the elements with which ball and segment grow, and along the segment towards
/// its thinner end.
void push_by_growth(const Scene& scene, State& state, const GrownTouch& touch);

}  // namespace cellcrush

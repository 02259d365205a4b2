#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "cellcrush/vector.h"

namespace cellcrush {

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

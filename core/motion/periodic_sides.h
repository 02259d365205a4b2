#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "motion/motion_works.h"

namespace cellcrush {

// Sides that repeat (E9i). The motion of an image is that of its joint, and the speed at which the period grows. The
// forces that keep it so do no work: they are added to the internal forces of both, so that the central differences
// (E2) of the particles hold as they are. Of a free width, the mean force across the crush is that of its inertia.

/// Adds these forces. `on_width`: of contacts across the sides.
void tie_sides(const Scene& scene, const SideForce& on_width, State& state);

/// Moves the width by a step, as the joints have moved; images keep no round-off of their own.
void move_sides(const Scene& scene, State& state);

/// Sets the speed of the width half a step before time 0, as that of the joints (E2b).
void stagger_sides(const Scene& scene, State& state);

/// The works of the contacts across the sides over the newest step of the width (E10); their works on particles do not
/// have it.
MotionWorks works_of_sides(const State& state);

/// The same over the half step up to the time of the state.
MotionWorks half_step_works_of_sides(const Scene& scene, const State& state);

}  // namespace cellcrush

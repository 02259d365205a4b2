#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "motion/motion_works.h"

namespace cellcrush {

// Rigid bodies: their particles keep their places in the body, whose centre and rotation follow from the sums of the
// forces and of the moments about the centre, M dV/dt = sum F, I d(omega)/dt = sum (m + r x F), in the central
// differences of the particles (E2).

/// Puts the bodies where they are before loading, at rest.
void place_rigid_bodies(const Scene& scene, State& state);

/// Moves the bodies' velocities from time 0 to half a step before it, with the forces at time 0.
void stagger_rigid_bodies(const Scene& scene, State& state);

/// Moves the bodies, their particles and the axes of their walls by a step. Returns the works of the forces on them.
MotionWorks move_rigid_bodies(const Scene& scene, State& state);

/// The works of the forces on the bodies over the half step up to the state's time, and twice their kinetic energy
/// then.
MotionWorks half_step_works_of_rigid_bodies(const Scene& scene, const State& state);

}  // namespace cellcrush

#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "motion/motion_works.h"

namespace cellcrush {

// Rigid bodies (E13). Their particles keep their positions in the body. The centre and the rotation of a body follow
// from the sums of the forces and of the moments about the centre, M dV/dt = sum F, I d(omega)/dt = sum (m + r x F).
// They are integrated by the central differences of the particles (E2).

/// Gives the bodies the momentum that their particles have by the initial velocities of nodes.
void start_rigid_bodies(const Scene& scene, State& state);

/// Moves the velocities of the bodies from time 0 to half a step before, with the forces at time 0 (E2b).
void stagger_rigid_bodies(const Scene& scene, State& state);

/// Moves the bodies, their particles and the axes of their walls by a step. Returns the works of the forces on them.
MotionWorks move_rigid_bodies(const Scene& scene, State& state);

/// The works of the forces on the bodies over the half step up to the time of the state, and twice their kinetic energy
/// at that time.
MotionWorks half_step_works_of_rigid_bodies(const Scene& scene, const State& state);

}  // namespace cellcrush

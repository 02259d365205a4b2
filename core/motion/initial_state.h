#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// A state with undeformed positions and the initial velocities of the scene, without forces.
State place_particles(const Scene& scene);

/// Moves the velocities from time 0 to half a step before, with the forces at time 0 (E2b).
void stagger_velocities(const Scene& scene, State& state);

}  // namespace cellcrush

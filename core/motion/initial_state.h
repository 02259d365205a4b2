#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// A state with particles in place, at the scene's initial velocities, without forces.
State place_particles(const Scene& scene);

/// Moves the velocities from time 0 to half a step before it, with the forces at time 0.
void stagger_velocities(const Scene& scene, State& state);

}  // namespace cellcrush

#pragma once

#include <cstdint>

#include "cellcrush/scene.h"
#include "cellcrush/stage.h"
#include "cellcrush/state.h"
#include "step/workspace.h"

namespace cellcrush {

/// The state before the first step: undeformed positions, forces evaluated, velocities half a step back (E2b).
State make_initial_state(const Scene& scene);

/// Advances the state by one step of the explicit method: motion from the forces at the old time, then the forces at
/// the new time. The observer, if any, is called when a stage begins. `workspace` is reused by the next step.
void advance_step(const Scene& scene, State& state, Workspace& workspace, StageObserver* observer);

/// Sums the forces of walls on joints again, and evaluates all others, in place and without motion, after the mesh has
/// changed. REQUIRES: those others are cleared.
void evaluate_forces_again(Scene& scene, State& state, Workspace& workspace);

/// Advances the state by some steps, in wavefronts for a large lattice (step/advance_wavefront.h), to the same bits.
void advance_steps(const Scene& scene, State& state, Workspace& workspace, std::int64_t steps, StageObserver* observer);

/// The same for a single step, with a workspace of its own.
void advance_step(const Scene& scene, State& state, StageObserver* observer);

}  // namespace cellcrush

#pragma once

#include <cstdint>

#include "cellcrush/scene.h"
#include "cellcrush/stage.h"
#include "cellcrush/state.h"
#include "step/workspace.h"

namespace cellcrush {

/// The state before the first step: particles in place, forces evaluated, velocities half a step back.
State make_initial_state(const Scene& scene);

/// Advances the state by one step of the explicit method: motion from the forces at the old time, then the forces at
/// the new one. The observer, if any, is called when a stage begins. `workspace` is kept for the next step.
void advance_step(const Scene& scene, State& state, Workspace& workspace, StageObserver* observer);

/// Advances the state by some steps; those of a large lattice block by block (step/advance_block.h), to the same bits.
void advance_steps(const Scene& scene, State& state, Workspace& workspace, std::int64_t steps, StageObserver* observer);

/// The same of a single step, with room of its own.
void advance_step(const Scene& scene, State& state, StageObserver* observer);

}  // namespace cellcrush

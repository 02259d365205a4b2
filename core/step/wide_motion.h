#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"

namespace cellcrush {

/// The particles' part of integrate_motion with the processor's vector instructions: the same equations as next_velocity and
/// accumulate_work. Returns false, and does nothing, for scenes with supports or loads.
bool move_particles_wide(const Scene& scene, State& state, Workers& workers);

}  // namespace cellcrush

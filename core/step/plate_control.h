#pragma once

#include <cstdint>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

// The speed of the plate in a quasi-static crush (loading.quasi_static; scene/quasi_static.h has the plan). Every
// control_interval() steps it is set from the energies, whatever samples and checkpoints are taken. In between it
// changes evenly. It starts at a small fraction of the greatest speed and
//   - rises while the kinetic energy is under a low part of the bound on its share of the work,
//   - falls while it is above a high part,
//   - is at least what is left to travel over the time left, once that is half of the greatest speed.
// So the run ends at its strain within most_steps_of(); whether it kept the bound, its result says.

/// Whether the speed is controlled.
bool is_controlled(const Scene& scene);

/// Most steps of a run: the planned ones, or more where the speed is controlled.
std::int64_t most_steps_of(const Scene& scene);

/// Steps between two settings of the speed.
std::int64_t control_interval(const Schedule& schedule);

/// Sets the speed until the next time.
void control_plate(const Scene& scene, State& state);

/// Whether a controlled plate has arrived at its end.
bool has_arrived(const Scene& scene, const State& state);

/// Steps, at least 1, that cannot take a controlled plate past its end by more than a step.
std::int64_t steps_to_arrival(const Scene& scene, const State& state);

}  // namespace cellcrush

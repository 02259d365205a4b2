#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Overwrites load_force and load_moment with the nodal loads at the state's time (P, Q of Eq. 4).
void evaluate_loads(const Scene& scene, State& state);

}  // namespace cellcrush

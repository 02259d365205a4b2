#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Overwrites load_force and load_moment with gravity, the nodal loads and the elements' loads at the
/// state's time (P, Q, p, q of Eq. 4).
void evaluate_loads(const Scene& scene, State& state);

}  // namespace cellcrush

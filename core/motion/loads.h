#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Overwrites load_force and load_moment by gravity, nodal loads and element loads at the time of the state (P, Q, p, q
/// of Eq. 4; E14).
void evaluate_loads(const Scene& scene, State& state);

}  // namespace cellcrush

#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Imposed velocity v_held of a held degree of freedom over the coming step, mm/s or rad/s (E15); 0 if it is held
/// still.
double held_velocity(const Scene& scene, const State& state, const Hold& hold);

}  // namespace cellcrush

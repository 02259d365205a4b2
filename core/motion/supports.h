#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Velocity, mm/s or rad/s, that makes a held motion follow its function over the coming step; 0 where it stands.
double held_velocity(const Scene& scene, const State& state, const Hold& hold);

}  // namespace cellcrush

#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Of all particles of a grip, mm.
Vector2 displacement_of(const Scene& scene, const State& state, const Grip& grip);

/// Of a grip on the lattice since the start, N s: the sum over its particles.
Vector2 impulse_of(const Scene& scene, const State& state, const Grip& grip);

}  // namespace cellcrush

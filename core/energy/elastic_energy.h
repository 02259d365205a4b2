#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Elastic energy of all elements, N mm, from the current stresses (E10). Accepts any section rule.
double elastic_energy(const Scene& scene, const State& state);

}  // namespace cellcrush

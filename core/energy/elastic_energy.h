#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Elastic energy of all elements, N mm, of the stresses as they are (E10). Takes any section rule.
double elastic_energy(const Scene& scene, const State& state);

}  // namespace cellcrush

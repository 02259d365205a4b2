#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Elastic energy of all elements, N mm, of the stresses as they are (E10), with the processor's vector instructions. Takes any
/// section rule.
double elastic_energy_wide(const Scene& scene, const State& state);

}  // namespace cellcrush

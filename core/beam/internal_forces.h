#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"

namespace cellcrush {

/// Overwrites axis, length, fibres and internal forces of every element from the particles' motion over the last step
/// (Eq. 7-32), and adds the plastic work of the step to the ledger. The plain text runs on one thread.
void evaluate_internal_forces(const Scene& scene, State& state, Workers& workers);

}  // namespace cellcrush

#pragma once

#include <functional>

#include "beam/walls_workspace.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"

namespace cellcrush {

/// Overwrites axis, length, fibres and internal forces of every element from the particles' motion over the last step
/// (Eq. 7-32), and adds the plastic work of the step to the ledger. The plain text runs on one thread. Calls `meanwhile` once, on the
/// caller's thread, when axes and lengths are those of now: while it goes on with them and with the motion, other threads may be
/// at fibres and forces.
void evaluate_internal_forces(const Scene& scene, State& state, WallsWorkspace& workspace, Workers& workers,
                              const std::function<void()>& meanwhile);

}  // namespace cellcrush

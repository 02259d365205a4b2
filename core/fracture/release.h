#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Steps in which an end that has broken off is released. Released at once, it would swing back within a step, and its
/// section yield in one increment: the ledger would gain up to a tenth of the work of a broken wall. The time is that
/// of some waves through an element.
inline constexpr int kReleaseSteps = 32;

/// Adds to the internal forces what acts between ends that have broken off in the last steps and their joints: the
/// force that would hold them together, times a share that falls from 1 to 0 (E6g). Adds its work so far to
/// Break::released. REQUIRES: all other forces on particles are evaluated.
void release_ends(const Scene& scene, State& state);

}  // namespace cellcrush

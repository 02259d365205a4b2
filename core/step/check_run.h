#pragma once

#include "cellcrush/sample.h"
#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Says whether a run can go on: `running`, or `diverged` when a particle's motion is no longer finite, or `energy_balance`
/// when the ledger has opened by more than kLargestEnergyError of the work done; with place, step and remedy in words.
inline constexpr double kLargestEnergyError = 0.10;
RunStatus check_run(const Scene& scene, const State& state, const Sample& sample);

}  // namespace cellcrush

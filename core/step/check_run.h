#pragma once

#include "cellcrush/sample.h"
#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Share of the work done by which the ledger may be open, and that contacts may have made.
inline constexpr double kLargestEnergyError = 0.10;

/// Rotation of a particle in a step, rad, up to which sines are angles to 1 %. Sound crushes up to 400 m/s stay under
/// 0.05. The ends of an element that turns so fast move at half of the speed of sound in it, at the longest stable
/// step.
inline constexpr double kLargestRotation = 0.25;

/// Says whether the result of a run is still true: `running`, or with place, step and remedy in words
///   diverged        a motion, a force or an energy is no longer finite,
///   large_rotation  a particle turns by more than kLargestRotation in this step,
///   energy_balance  the ledger is open by more than kLargestEnergyError of the work done,
///   contact_energy  contacts have made more than that: what the ledger books like any other work.
/// Only the state of now is looked at; what happened since the sample before shows in the sums of the ledger.
RunStatus check_run(const Scene& scene, const State& state, const Sample& sample);

}  // namespace cellcrush

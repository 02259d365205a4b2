#pragma once

#include "cellcrush/sample.h"
#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Greatest error of the energy balance, and greatest energy created by contacts, as a fraction of the work done.
inline constexpr double kLargestEnergyError = 0.10;

/// Greatest rotation of a particle in a step, rad: sines then equal angles to 1 %. Sound crushes at up to 400 m/s stay
/// below 0.05. At the longest stable step, the ends of an element that turns so fast move at half of the speed of sound
/// in it.
inline constexpr double kLargestRotation = 0.25;

/// Greatest solid fraction of a layer. Walls then overlap by a fifth of their thickness on average, and the deepest
/// contacts by half of it: pressed to the middle of a wall, a contact no longer resists as metal would.
inline constexpr double kMostCompaction = 1.25;

/// Checks whether the result of a run can still be trusted. Returns `running`, or one of these with the place, the step
/// and a remedy in words:
///   diverged        a motion, a force or an energy is not finite,
///   large_rotation  a particle rotates by more than kLargestRotation in this step,
///   energy_balance  the energy balance has an error of more than kLargestEnergyError of the work done,
///   contact_energy  contacts have created more than that; the ledger counts it like any other work,
///   wall_crossing   a wall has passed through another: its contacts push to the wrong side from then on,
///   overcompaction  a layer is filled to more than kMostCompaction,
///   inertia         the kinetic energy of mass that the material does not have is more than kLargestInertia
///                   (measure/inertia.h) of the work done, in the plateau window,
///   contact_lost    in a step since the start, particles of a frame could approach each other by more than
///                   ContactLaw::most_travel, or a beam has sunk into another by the thickness of the thinner one.
/// Only the current state is checked; events since the last sample show in the sums of the ledger and in what the state
/// records since the start.
RunStatus check_run(const Scene& scene, const State& state, const Sample& sample);

}  // namespace cellcrush

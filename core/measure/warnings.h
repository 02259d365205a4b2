#pragma once

#include <span>
#include <vector>

#include "cellcrush/sample.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

// What does not make a result untrue but must be read with it. Warnings do not end a run: a wall that has been pressed
// past the middle of another, or through it, may leave the stresses as they are, and whether it does only another run
// shows. What makes a result untrue ends the run (step/check_run.h).

/// Share of the thinner wall's thickness from which an overlap is deep: a sound contact stays under a quarter.
inline constexpr double kDeepPenetration = 0.5;
/// Share of the work done beyond which the ledger drifts, or contacts make energy.
inline constexpr double kEnergyDrift = 0.01;

/// Either says where walls overlap deepest now.
Warning warn_of_depth(const Scene& scene, const State& state, double strain);
Warning warn_of_crossing(const Scene& scene, const State& state, double strain);
/// Of what bands of the lattice are not held against (search/border_check.h): costs time, and no accuracy.
Warning warn_of_borders(const Scene& scene, const State& state, double strain);

/// The work done by a sample, or the kinetic energy of all that has been put in, whichever is more, N mm: what an error
/// of the energy is compared with.
double turnover_of(const Sample& sample);

/// The samples' warnings, and those of the ledger: by step. Samples before a hundredth of the greatest turnover, which
/// compare two small numbers, do not count.
std::vector<Warning> collect_warnings(std::span<const Sample> samples);

}  // namespace cellcrush

#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "cellcrush/sample.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

// Warnings do not make a result invalid but must be read with it. They do not end a run: a wall that has been pressed
// past the middle of another, or through it, may leave the stresses as they are. Only another run shows whether it
// does. Errors that make a result invalid end the run (step/check_run.h).

/// Overlap, as a fraction of the thickness of the thinner wall, from which it is deep; a sound contact stays below a
/// quarter.
inline constexpr double kDeepPenetration = 0.5;
/// Solid fraction of a layer from which it is reported.
inline constexpr double kSolid = 1.0;
/// Fraction of the walls beyond which walls that would have necked are reported.
inline constexpr double kNeckedWalls = 0.01;
/// Fraction of the work done beyond which the ledger drifts, or contacts create energy.
inline constexpr double kEnergyDrift = 0.01;

/// Warns of deep overlap. Names where walls overlap deepest now.
Warning warn_of_depth(const Scene& scene, const State& state, double strain);
/// Warns of a layer that walls fill by more than its volume: denser than solid metal.
Warning warn_of_density(const State& state, const Sample& sample);
/// Warns that a lattice between plates, or a frame between rigid walls, is closed (scene/solid_area.h).
Warning warn_of_closing(const Scene& scene, const State& state, double strain);
/// Warns that distant parts of the border, which bands do not test against each other, came near
/// (contact/contact_search.h). This costs time but no accuracy.
Warning warn_of_borders(const State& state, double strain);

/// Warns of walls that real metal would have torn: more than kNeckedWalls of all have been stretched by more than their
/// thickness beyond the strain up to which they stretch evenly (E5c). Names the one that is stretched most.
std::optional<Warning> warn_of_necks(const Scene& scene, const State& state, double strain);

/// The external work done by the time of a sample, or the kinetic energy including all energy put in at the start,
/// whichever is greater, N mm. Errors of the energy are compared with it.
double turnover_of(const Sample& sample);

/// The warnings of the samples, those of the ledger and that of inertia, in order of steps. For the ledger, samples
/// before a hundredth of the greatest turnover do not count, because they compare two small numbers.
std::vector<Warning> collect_warnings(const Scene& scene, std::span<const Sample> samples);

// Phrases for warnings and for the errors that end a run.

/// "; deepest now at particle 7, at (1, 2) mm before loading, in the wall of element 9"; empty while nothing touches.
std::string deepest_place(const Scene& scene, const State& state);

/// "Walls fill the layer that was 12 mm from the impact end before loading by 101.3 % of its volume".
std::string words_of(const DensestLayer& layer);

/// "step 12, t = 3e-6 s".
std::string moment_of(std::int64_t step, double time);

/// "particle 7, at (1, 2) mm before loading".
std::string place_of(const Scene& scene, std::size_t particle);

/// "-15.6 %", from a fraction.
std::string percent_of(double share);

}  // namespace cellcrush

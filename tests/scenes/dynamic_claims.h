#pragma once

#include <utility>
#include <vector>

#include "cellcrush/sample.h"
#include "scenes/dynamic_frames.h"

namespace cellcrush::scenes {

// What the samples of the dynamic frames must show, whether a test ran them itself or fetched them from a daemon. Each
// reports through GoogleTest.

/// The struck cantilever comes to rest, but for elastic vibration, within 2 % of Parkes's deflection and 3 % of his
/// time; the plastic work is the energy it was struck with but for what vibrates on, within 1 %. Returns deflection and
/// time over his.
std::pair<double, double> expect_parkes(const std::vector<Sample>& samples);

/// The spinning bar's mean stretch is rho omega^2 L^3 / 3 E, that of its lumped masses within 0.1 %, and its energy is
/// kept: it swings with the explicit steps by a millionth and does not drift. Returns stretch over that of the lumped
/// masses, and the relative drift of the energy.
std::pair<double, double> expect_steady_stretch(const std::vector<Sample>& samples, int elements);

/// Returns the greatest deflection of the step-loaded cantilever over that at rest: within a hundredth of the modes'
/// sum.
double expect_dynamic_factor(const std::vector<Sample>& samples, const StepLoadedCantilever& cantilever);

/// Root mean square over the samples of the deflection's difference to the modes' sum, over the static deflection.
double modal_error(const std::vector<Sample>& samples, const StepLoadedCantilever& cantilever);

}  // namespace cellcrush::scenes

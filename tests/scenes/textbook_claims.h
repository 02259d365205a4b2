#pragma once

#include <utility>
#include <vector>

#include "cellcrush/sample.h"

namespace cellcrush::scenes {

// What the samples of the textbook frames must show, whether a test ran them itself or fetched them from a daemon. Each
// reports through GoogleTest.

/// Moment against curvature of a rectangular bilinear section, exact: with k_e the curvature at yield,
///   M = (1 - E_T / E) M_e (1.5 - 0.5 (k_e / k)^2) + E_T I k;  the unloading slope is EI. Returns the
/// worst relative errors of the moment and of the slope.
std::pair<double, double> expect_moment_curvature_law(const std::vector<Sample>& samples, double peak);

/// Plastic work of the cycles: the same from the second on (returns the worst relative difference); falling toward none
/// (returns that of the last over the largest).
double expect_closed_cycles(const std::vector<Sample>& samples, int cycles);
double expect_shakedown(const std::vector<Sample>& samples, int cycles);

/// Force at the end is factor M_p / L, and it stays there. Returns the force over that.
double expect_limit_load(const std::vector<Sample>& samples, double WatchedNode::*component, double factor);

/// First limit 1.8557 N at a deflection of 48.74 mm. Returns force and deflection.
std::pair<double, double> expect_lee_limit(const std::vector<Sample>& samples);

/// Load over buckling load, and the end angle of the elastica in degrees.
inline constexpr std::pair<double, double> kColumnAngles[] = {{1.01540, 20.0}, {1.15172, 60.0}, {1.39320, 90.0}};
/// Returns the relative error.
double expect_end_angle(const std::vector<Sample>& samples, double degrees);

}  // namespace cellcrush::scenes

#pragma once

#include <cstdint>
#include <string>

#include "cellcrush/scene.h"

namespace cellcrush {

// Phrases for diagnoses and warnings.

/// "step 12, t = 3e-6 s".
std::string moment_of(std::int64_t step, double time);

/// "particle 7, at (1, 2) mm before loading".
std::string place_of(const Scene& scene, std::size_t particle);

/// "-15.6 %", from a fraction.
std::string percent_of(double share);

}  // namespace cellcrush

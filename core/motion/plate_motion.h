#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Fraction of its greatest speed at which a controlled plate starts.
inline constexpr double kStartOfControl = 1.0 / 64.0;

/// Speed of the impact plate at a time since the newest setting, mm/s.
double plate_speed_at(const Scene& scene, const State& state, double time);

}  // namespace cellcrush

#pragma once

#include <cmath>

#include "cellcrush/scene.h"

namespace cellcrush::scenes {

/// The unit vector at an angle from the x axis, rad.
inline Vector2 direction(double angle) { return {std::cos(angle), std::sin(angle)}; }

}  // namespace cellcrush::scenes

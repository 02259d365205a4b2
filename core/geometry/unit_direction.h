#pragma once

#include <cmath>
#include <numbers>

#include "cellcrush/vector.h"

namespace cellcrush {

/// Direction at an angle to the x axis, of -90 to 90 degrees. The sine is rounded to 2^-44, far above the differences
/// of libraries, so that the direction has the same bits on every machine; that of 30 degrees is exactly one half.
inline Vector2 unit_direction(double degrees) {
  const double sine = std::ldexp(std::round(std::ldexp(std::sin(degrees * std::numbers::pi / 180.0), 44)), -44);
  return {std::sqrt(1.0 - sine * sine), sine};
}

}  // namespace cellcrush

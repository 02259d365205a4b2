#pragma once

#include <algorithm>

namespace cellcrush {

/// Bilinear Coulomb friction (Eq. 44-47, E9b). The force of the step before, minus k times the slip of this step, is
/// clamped to `limit`, the friction coefficient times the normal force. N; `slip` in mm, in the direction that the
/// force opposes.
inline double evaluate_friction(double previous, double stiffness, double slip, double limit) {
  return std::clamp(previous - stiffness * slip, -limit, limit);
}

}  // namespace cellcrush

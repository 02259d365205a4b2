#pragma once

#include <algorithm>

namespace cellcrush {

/// Bilinear Coulomb friction (Eq. 44-47): the force of the step before, changed by k times the slip of this step, held
/// within the friction coefficient times the normal force. `previous` in N, `slip` in mm against which the force grows.
inline double evaluate_friction(double previous, double stiffness, double slip, double limit) {
  return std::clamp(previous - stiffness * slip, -limit, limit);
}

}  // namespace cellcrush

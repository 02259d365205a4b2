#pragma once

#include <algorithm>
#include <cmath>

namespace cellcrush::reference {

/// Viscous part of a penalty force (Eq. 43, E9) that does not pull. `approach` is dD/dt.
inline double viscous_force(double stiffness, double damping_ratio, double inverse_mass, double approach,
                            double elastic) {
  const double damping = 2.0 * damping_ratio * std::sqrt(stiffness / inverse_mass);  // c
  return std::max(damping * approach, -elastic);
}

/// Friction after a slip (Eq. 44-47, E9b).
inline double friction_after(double before, double stiffness, double slip, double limit) {
  return std::clamp(before - stiffness * slip, -limit, limit);
}

}  // namespace cellcrush::reference

#pragma once

#include <algorithm>
#include <cmath>

namespace cellcrush {

/// The two parts of a penalty force along the contact's normal, N; their sum is never negative.
struct NormalForce {
  double elastic;  ///< k D
  double viscous;  ///< c dD/dt, at least -k D
};

/// Viscous force c dD/dt of a contact that deepens at `rate` (mm/s): c = 2 damping_ratio sqrt(k m), with the effective mass
/// m = 1 / inverse_mass.
inline double viscous_force(double stiffness, double damping_ratio, double inverse_mass, double rate) {
  return 2.0 * damping_ratio * std::sqrt(stiffness / inverse_mass) * rate;
}

/// Deviation from Eq. 43: the sum is clamped at 0, as a contact does not pull.
inline NormalForce without_pull(double elastic, double viscous) { return {elastic, std::max(viscous, -elastic)}; }

/// Penalty force of a contact of depth D > 0 (mm) that deepens at `rate` (Eq. 43, the contact area taken into k and c).
inline NormalForce evaluate_normal_force(double stiffness, double damping_ratio, double inverse_mass, double depth,
                                         double rate) {
  return without_pull(stiffness * depth, viscous_force(stiffness, damping_ratio, inverse_mass, rate));
}

}  // namespace cellcrush

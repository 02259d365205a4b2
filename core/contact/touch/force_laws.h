#pragma once

#include <algorithm>

namespace cellcrush {

/// The two parts of a penalty force along the normal of a contact, N (E8); their sum is never negative.
struct NormalForce {
  double elastic;  ///< k D
  double viscous;  ///< c dD/dt, at least -k D
};

/// Deviation from Eq. 43: the sum is clamped at 0, as a contact does not pull (E8).
inline NormalForce without_pull(double elastic, double viscous) { return {elastic, std::max(viscous, -elastic)}; }

/// Penalty force of a contact of depth D > 0 (mm) that deepens at `rate` (mm/s) (Eq. 43, E8). k and c include the
/// contact area (E9, contact/touch/viscous_force-inl.h).
NormalForce evaluate_normal_force(double stiffness, double damping_ratio, double inverse_mass, double depth,
                                  double rate);

/// Bilinear Coulomb friction (Eq. 44-47, E9b). The force of the step before, minus k times the slip of this step, is
/// clamped to `limit`, the friction coefficient times the normal force. N; `slip` in mm, in the direction that the
/// force opposes.
inline double evaluate_friction(double previous, double stiffness, double slip, double limit) {
  return std::clamp(previous - stiffness * slip, -limit, limit);
}

}  // namespace cellcrush

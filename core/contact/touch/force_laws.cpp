#include "contact/touch/force_laws.h"

#include "contact/touch/viscous_force-inl.h"

namespace cellcrush {

NormalForce evaluate_normal_force(double stiffness, double damping_ratio, double inverse_mass, double depth,
                                  double rate) {
  const double viscous = HWY_NAMESPACE::viscous_force(stiffness, damping_ratio, inverse_mass, rate);
  return without_pull(stiffness * depth, viscous);
}

}  // namespace cellcrush

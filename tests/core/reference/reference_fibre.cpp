#include "core/reference/reference_fibre.h"

#include <cmath>

namespace cellcrush::reference {

Flow return_fibre(const Material& material, double strain_increment, Fibre& fibre) {
  const double isotropic = material.isotropic_fraction * material.hardening_modulus;
  const double kinematic = (1.0 - material.isotropic_fraction) * material.hardening_modulus;
  const double yield = material.yield_stress + isotropic * fibre.plastic_strain;  // Eq. 33
  fibre.stress += material.modulus * strain_increment;                            // Eq. 34
  const double reduced = fibre.stress - fibre.back_stress;                        // Eq. 35
  const double excess = std::abs(reduced) - yield;                                // Eq. 35, absolute value added
  if (excess <= 0.0) {
    return {};
  }
  const double size = excess / (material.modulus + material.hardening_modulus);  // Eq. 37
  const double increment = std::copysign(size, reduced);                         // Eq. 38
  const double begin = std::copysign(yield, reduced) + fibre.back_stress;        // where the flow begins
  fibre.stress -= material.modulus * increment;                                  // Eq. 36
  fibre.back_stress += kinematic * increment;                                    // Eq. 39
  fibre.plastic_strain += size;                                                  // Eq. 39
  return {increment, 0.5 * (begin + fibre.stress) * increment};
}

}  // namespace cellcrush::reference

#include <algorithm>
#include <cmath>

#include "core/reference/reference_element.h"

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

double strained_length(const ElementRule& rule, const ElementData& data, double plastic_length) {
  return rule.constant_area ? data.undeformed_length : plastic_length;
}

double volume_of(const ElementData& data) { return data.depth * data.thickness * data.undeformed_length; }

namespace {

/// The square of the greatest frequency times that of l / c.
double bending_frequency(const ElementData& data, double length) {
  const double g = data.thickness * data.thickness / 12.0 / (length * length);
  if (!data.in_pair) {
    return 3.0 * (1.0 + 4.0 * g);  // E11
  }
  const double a = 4.0 + 48.0 * g;  // E11c
  return (a + std::sqrt(a * a - 192.0 * g)) / 2.0;
}

}  // namespace

double squashed_modulus(const ElementRule& rule, const ElementData& data, double plastic_length) {
  const double bound = 0.95 * data.undeformed_length;
  if (plastic_length >= bound) {
    return data.material.modulus;
  }
  const double power = rule.constant_area ? 0.0 : 2.0;
  const double thickness = 1.0 + 2.0 * thickening_of(rule, data, plastic_length).growth / data.thickness;  // h / h_0
  return data.material.modulus * std::pow(plastic_length / bound, power) / (thickness * thickness) *
         bending_frequency(data, bound) / bending_frequency(data, plastic_length);
}

Thickening thickening_of(const ElementRule& rule, const ElementData& data, double length) {
  const double power = data.material.plane_strain ? 1.0 : 0.5;
  const double relative = std::pow(data.undeformed_length / length, power);  // (l_0 / l)^p
  const double growth = relative - 1.1;                                      // of h / h_0
  const double half = data.thickness / 2.0;
  if (rule.constant_area || growth <= 0.0) {
    return {};
  }
  return growth < 1.0 ? Thickening{half * growth, -half * power * relative / length} : Thickening{half, 0.0};
}

}  // namespace cellcrush::reference

#include <algorithm>
#include <cmath>

#include "core/reference/reference_element.h"

namespace cellcrush::reference {

namespace {

/// c of E6d: what hardening adds to the yield stress.
double hardened(const Material& material, double plastic_strain) {
  const Curves& of = material.curves;
  const double voce = of.voce_stress * (1.0 - std::exp(-of.voce_exponent * plastic_strain));
  const double ludwik = of.ludwik_stress > 0.0 ? of.ludwik_stress * std::pow(plastic_strain, of.ludwik_exponent) : 0.0;
  return material.hardening_modulus * plastic_strain + voce + ludwik;
}

/// R of E6e.
double hastened(const Curves& of, double rate) {
  const double symonds = of.symonds_rate > 0.0 ? std::pow(rate / of.symonds_rate, 1.0 / of.symonds_exponent) : 0.0;
  const double johnson = rate > of.johnson_rate ? of.johnson_coefficient * std::log(rate / of.johnson_rate) : 0.0;
  return 1.0 + symonds + johnson;
}

/// The root of E6f, by bisection.
double flow_of(const Material& material, double plastic_strain, double reduced) {
  const double before = hardened(material, plastic_strain);
  const double beta = material.isotropic_fraction;
  double low = 0.0;
  double high = reduced / material.modulus;
  for (double middle = 0.5 * high; middle > low && middle < high; middle = 0.5 * (low + high)) {
    const double after = hardened(material, plastic_strain + middle);
    const double surface =
        (material.yield_stress + beta * after) * hastened(material.curves, middle / material.curves.step);
    const double borne = material.modulus * middle + (1.0 - beta) * (after - before) + surface;
    (borne < reduced ? low : high) = middle;
  }
  return low;
}

bool has_curves(const Curves& of) {
  return of.voce_stress > 0.0 || of.ludwik_stress > 0.0 || of.symonds_rate > 0.0 || of.johnson_coefficient > 0.0;
}

}  // namespace

Flow return_fibre(const Material& material, double strain_increment, Fibre& fibre) {
  const double before = hardened(material, fibre.plastic_strain);
  const double yield = material.yield_stress + material.isotropic_fraction * before;  // Eq. 33
  const double old = fibre.stress - fibre.back_stress;
  fibre.stress += material.modulus * strain_increment;      // Eq. 34
  const double reduced = fibre.stress - fibre.back_stress;  // Eq. 35
  const double excess = std::abs(reduced) - yield;          // Eq. 35, absolute value added
  if (excess <= 0.0) {
    return {};
  }
  const double size = has_curves(material.curves) ? flow_of(material, fibre.plastic_strain, std::abs(reduced))
                                                  : excess / (material.modulus + material.hardening_modulus);  // Eq. 37
  const double increment = std::copysign(size, reduced);                                                       // Eq. 38
  // Where the flow begins: at rest, or beyond it by what the rate before has left.
  const double overstress = has_curves(material.curves) ? std::copysign(1.0, reduced) * old : 0.0;
  const double begin = std::copysign(std::max(yield, overstress), reduced) + fibre.back_stress;
  fibre.stress -= material.modulus * increment;  // Eq. 36
  fibre.plastic_strain += size;                  // Eq. 39
  const double kinematic = (1.0 - material.isotropic_fraction) * (hardened(material, fibre.plastic_strain) - before);
  fibre.back_stress += std::copysign(kinematic, reduced);  // Eq. 39
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

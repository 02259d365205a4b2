#pragma once

#include <cmath>

#include "cellcrush/scene.h"

namespace cellcrush {

/// What the fibres of an element remember, in the state's arrays, `count` of each. MPa; plastic_strain is the accumulated
/// (effective) one.
struct Fibres {
  double* __restrict stress;
  double* __restrict back_stress;
  double* __restrict plastic_strain;
};

/// Forces that the stresses of an element's fibres do work with, before the section's measures are put on (Eq. 28), and the
/// plastic work of the step over the volume.
struct FibreSums {
  double axial = 0.0;         ///< MPa
  double moment_start = 0.0;  ///< MPa
  double moment_end = 0.0;    ///< MPa
  double plastic_work = 0.0;  ///< MPa
};

/// Radial return of all fibres of an element over a step (Eq. 33-39), and the sums of Eq. 28 over them.
///
/// Strain increments are membrane + start start_factor + end end_factor of the rule (Eq. 27).
/// Deviation from the paper: the yield test and the plastic increment take the absolute value of the reduced stress
/// (Eq. 35-38 leave it out, which would let a compressed fibre never yield). Written without a branch: what of the reduced
/// stress lies outside of the yield surface is what it loses when it is clamped to it.
inline FibreSums integrate_fibres(const Material& material, const SectionRule& rule, double membrane, double start,
                                  double end, Fibres fibres) {
  const double modulus = material.youngs_modulus;
  const double inverse = 1.0 / (modulus + material.hardening_modulus);
  const double isotropic = material.isotropic_fraction * material.hardening_modulus;
  const double kinematic = material.hardening_modulus - isotropic;
  const double* __restrict start_factor = rule.start_factor.data();
  const double* __restrict end_factor = rule.end_factor.data();
  const double* __restrict weight = rule.weight.data();
  const Eigen::Index count = rule.weight.size();
  FibreSums sums;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double strain_increment = membrane + start * start_factor[i] + end * end_factor[i];
    const double trial = fibres.stress[i] + modulus * strain_increment;                 // Eq. 34
    const double reduced = trial - fibres.back_stress[i];                               // Eq. 35
    const double yield = material.yield_stress + isotropic * fibres.plastic_strain[i];  // Eq. 33
    const double clamped = reduced > yield ? yield : (reduced < -yield ? -yield : reduced);
    const double plastic_increment = inverse * (reduced - clamped);  // Eq. 37, 38
    const double stress = trial - modulus * plastic_increment;       // Eq. 36
    fibres.stress[i] = stress;
    fibres.back_stress[i] += kinematic * plastic_increment;  // Eq. 39
    fibres.plastic_strain[i] += std::abs(plastic_increment);
    const double weighted = weight[i] * stress;
    sums.axial += weighted;
    sums.moment_start += weighted * start_factor[i];
    sums.moment_end += weighted * end_factor[i];
    sums.plastic_work += weighted * plastic_increment;
  }
  return sums;
}

}  // namespace cellcrush

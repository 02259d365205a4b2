#pragma once

#include <cmath>
#include <cstdint>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// What the fibres of an element remember, in the state's arrays, every `stride`-th value of them. MPa; plastic_strain is the
/// accumulated (effective) one. Without hardening there is neither back stress nor plastic strain, but a bit for each fibre
/// that has flowed. T: double or float.
template <class T>
struct Fibres {
  T* __restrict stress;
  T* __restrict back_stress;
  T* __restrict plastic_strain;
  typename FibreMemory<T>::Bits* __restrict flowed;
  std::size_t stride = 1;
};

/// Where a step's return writes, before it is committed: stress and signed plastic strain increment of each fibre.
struct FibreStep {
  double* __restrict stress;
  double* __restrict plastic_increment;

  [[nodiscard]] FibreStep from(std::size_t first) const { return {stress + first, plastic_increment + first}; }
};

/// Stresses of a section summed over its fibres, before its measures are put on (Eq. 28), and the plastic work of the step.
/// MPa, of area b h, of b h^2, and of volume.
struct SectionSums {
  double axial = 0.0;
  double moment = 0.0;
  double plastic_work = 0.0;
};

/// Radial return of the fibres of one section over a step (Eq. 33-39), from what they remember, which is left as it is.
/// `first` is the section's first fibre of the element.
///
/// Strain increments are membrane + bending y / h: `bending` is the increment of curvature times h, positive where the left
/// side stretches. Without kHardening neither back stress nor plastic strain is looked at.
/// Deviation from the paper: the yield test and the plastic increment take the absolute value of the reduced stress
/// (Eq. 35-38 leave it out, which would let a compressed fibre never yield). Written without a branch: what of the reduced
/// stress lies beyond the yield surface is what clamping takes off. Computed in double precision, whatever is remembered.
template <int kDepthPoints, bool kHardening, class T>
SectionSums return_section(const Material& material, const SectionRule& rule, double membrane, double bending,
                           const Fibres<T>& fibres, std::size_t first, FibreStep next) {
  const double modulus = material.youngs_modulus;
  const double inverse = 1.0 / (modulus + material.hardening_modulus);
  const double isotropic = material.isotropic_fraction * material.hardening_modulus;
  const double* __restrict offset = rule.offset.data();
  const double* __restrict weight = rule.depth_weight.data();
  const Eigen::Index count = kDepthPoints > 0 ? kDepthPoints : rule.offset.size();
  SectionSums sums;
  for (Eigen::Index i = 0; i < count; ++i) {
    const std::size_t place = (first + static_cast<std::size_t>(i)) * fibres.stride;
    const double trial = fibres.stress[place] + modulus * (membrane + bending * offset[i]);  // Eq. 34
    const double reduced = kHardening ? trial - fibres.back_stress[place] : trial;           // Eq. 35
    const double yield = kHardening ? material.yield_stress + isotropic * fibres.plastic_strain[place]
                                    : material.yield_stress;  // Eq. 33
    const double clamped = reduced > yield ? yield : (reduced < -yield ? -yield : reduced);
    const double plastic_increment = inverse * (reduced - clamped);  // Eq. 37, 38
    const double stress = trial - modulus * plastic_increment;       // Eq. 36
    next.stress[i] = stress;
    next.plastic_increment[i] = plastic_increment;
    const double weighted = weight[i] * stress;
    sums.axial += weighted;
    sums.moment += weighted * offset[i];
    sums.plastic_work += weighted * plastic_increment;
  }
  return sums;
}

/// Makes the fibres remember a step (Eq. 39).
template <bool kHardening, class T>
void commit_fibres(const Material& material, std::size_t count, FibreStep step, const Fibres<T>& fibres) {
  using Bits = typename FibreMemory<T>::Bits;
  const double kinematic = (1.0 - material.isotropic_fraction) * material.hardening_modulus;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t place = i * fibres.stride;
    fibres.stress[place] = static_cast<T>(step.stress[i]);
    if constexpr (kHardening) {
      fibres.plastic_strain[place] += static_cast<T>(std::abs(step.plastic_increment[i]));
      fibres.back_stress[place] += static_cast<T>(kinematic * step.plastic_increment[i]);
    } else {
      *fibres.flowed |= static_cast<Bits>(step.plastic_increment[i] != 0.0) << i;
    }
  }
}

}  // namespace cellcrush

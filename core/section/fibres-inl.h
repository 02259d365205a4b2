// Included once for each target. The text of section/fibres.h, a lane an element.
#if defined(CELLCRUSH_SECTION_FIBRES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_SECTION_FIBRES_INL_H_
#undef CELLCRUSH_SECTION_FIBRES_INL_H_
#else
#define CELLCRUSH_SECTION_FIBRES_INL_H_
#endif

#include <hwy/highway.h>

#include "section/fibres.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// Materials of the lanes.
template <class D>
struct LaneMaterial {
  hn::Vec<D> modulus;
  hn::Vec<D> yield_stress;
  hn::Vec<D> inverse;    ///< 1 / (E + H)
  hn::Vec<D> isotropic;  ///< beta H
  hn::Vec<D> kinematic;  ///< (1 - beta) H
  hn::Vec<D> hardening;  ///< H
};

template <class D>
struct LaneSectionSums {
  hn::Vec<D> axial;
  hn::Vec<D> moment;
  hn::Vec<D> plastic_work;
};

/// Radial return of the fibres of one section (Eq. 33-39); see return_section. `next` takes stress and plastic increment of
/// each fibre.
template <int kDepthPoints, bool kHardening, class D>
HWY_INLINE LaneSectionSums<D> return_section(D d, const LaneMaterial<D>& material, const SectionRule& rule,
                                             hn::Vec<D> membrane, hn::Vec<D> bending, const Fibres& fibres,
                                             std::size_t first, hn::Vec<D>* HWY_RESTRICT stress,
                                             hn::Vec<D>* HWY_RESTRICT plastic_increment) {
  const double* HWY_RESTRICT offset = rule.offset.data();
  const double* HWY_RESTRICT weight = rule.depth_weight.data();
  const int count = kDepthPoints > 0 ? kDepthPoints : static_cast<int>(rule.depth_count());
  const auto stretched = hn::Mul(material.modulus, membrane);
  const auto bent = hn::Mul(material.modulus, bending);
  LaneSectionSums<D> sums = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  for (int i = 0; i < count; ++i) {
    const std::size_t place = (first + static_cast<std::size_t>(i)) * fibres.stride;
    const auto trial =
        hn::Add(hn::LoadU(d, fibres.stress + place), hn::MulAdd(bent, hn::Set(d, offset[i]), stretched));  // Eq. 34
    if constexpr (kHardening) {
      const auto reduced = hn::Sub(trial, hn::LoadU(d, fibres.back_stress + place));  // Eq. 35
      const auto yield = hn::MulAdd(material.isotropic, hn::LoadU(d, fibres.plastic_strain + place),
                                    material.yield_stress);  // Eq. 33
      const auto clamped = hn::Max(hn::Min(reduced, yield), hn::Neg(yield));
      plastic_increment[i] = hn::Mul(material.inverse, hn::Sub(reduced, clamped));  // Eq. 37, 38
      stress[i] = hn::NegMulAdd(material.modulus, plastic_increment[i], trial);     // Eq. 36
    } else {
      stress[i] = hn::Max(hn::Min(trial, material.yield_stress), hn::Neg(material.yield_stress));
      plastic_increment[i] = hn::Sub(trial, stress[i]);  // times E
    }
    const auto weighted = hn::Mul(hn::Set(d, weight[i]), stress[i]);
    sums.axial = hn::Add(sums.axial, weighted);
    sums.moment = hn::MulAdd(weighted, hn::Set(d, offset[i]), sums.moment);
    sums.plastic_work = hn::MulAdd(weighted, plastic_increment[i], sums.plastic_work);
  }
  if constexpr (!kHardening) {
    sums.plastic_work = hn::Mul(material.inverse, sums.plastic_work);
  }
  return sums;
}

/// Makes the fibres remember a step (Eq. 39); see commit_fibres.
template <bool kHardening, class D>
HWY_INLINE void commit_fibres(D d, const LaneMaterial<D>& material, int count, const hn::Vec<D>* HWY_RESTRICT stress,
                              const hn::Vec<D>* HWY_RESTRICT plastic_increment, const Fibres& fibres) {
  const hn::RebindToUnsigned<D> bits;
  auto flowed = hn::Zero(bits);
  for (int i = 0; i < count; ++i) {
    const std::size_t place = static_cast<std::size_t>(i) * fibres.stride;
    hn::StoreU(stress[i], d, fibres.stress + place);
    if constexpr (kHardening) {
      double* strain = fibres.plastic_strain + place;
      double* back = fibres.back_stress + place;
      hn::StoreU(hn::Add(hn::LoadU(d, strain), hn::Abs(plastic_increment[i])), d, strain);
      hn::StoreU(hn::MulAdd(material.kinematic, plastic_increment[i], hn::LoadU(d, back)), d, back);
    } else {
      const auto flows = hn::RebindMask(bits, hn::Ne(plastic_increment[i], hn::Zero(d)));
      flowed = hn::Or(flowed, hn::IfThenElseZero(flows, hn::Set(bits, std::uint64_t{1} << i)));
    }
  }
  if constexpr (!kHardening) {
    hn::StoreU(hn::Or(flowed, hn::LoadU(bits, fibres.flowed)), bits, fibres.flowed);
  }
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_SECTION_FIBRES_INL_H_

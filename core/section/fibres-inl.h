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

/// Keeps the step of an element's fibres, stress and plastic increment, to be committed later or not at all.
template <class D>
struct KeptStep {
  hn::Vec<D>* HWY_RESTRICT stress;
  hn::Vec<D>* HWY_RESTRICT plastic_increment;

  HWY_INLINE void put(std::size_t fibre, hn::Vec<D> new_stress, hn::Vec<D> increment) {
    stress[fibre] = new_stress;
    plastic_increment[fibre] = increment;
  }
};

/// Makes the fibres remember a step at once (Eq. 39); see commit_fibres.
template <bool kHardening, class D>
class CommittedStep {
 public:
  HWY_INLINE CommittedStep(const LaneMaterial<D>& material, const Fibres& fibres)
      : material_(material), fibres_(fibres) {}

  HWY_INLINE void put(std::size_t fibre, hn::Vec<D> stress, hn::Vec<D> increment) {
    const std::size_t place = fibre * fibres_.stride;
    hn::StoreU(stress, d_, fibres_.stress + place);
    if constexpr (kHardening) {
      double* strain = fibres_.plastic_strain + place;
      double* back = fibres_.back_stress + place;
      hn::StoreU(hn::Add(hn::LoadU(d_, strain), hn::Abs(increment)), d_, strain);
      hn::StoreU(hn::MulAdd(material_.kinematic, increment, hn::LoadU(d_, back)), d_, back);
    } else {
      const auto flows = hn::RebindMask(bits_, hn::Ne(increment, hn::Zero(d_)));
      flowed_ = hn::Or(flowed_, hn::IfThenElseZero(flows, hn::Set(bits_, std::uint64_t{1} << fibre)));
    }
  }

  HWY_INLINE void finish() {
    if constexpr (!kHardening) {
      hn::StoreU(hn::Or(flowed_, hn::LoadU(bits_, fibres_.flowed)), bits_, fibres_.flowed);
    }
  }

 private:
  static constexpr D d_{};
  static constexpr hn::RebindToUnsigned<D> bits_{};
  const LaneMaterial<D>& material_;
  const Fibres& fibres_;
  hn::Vec<hn::RebindToUnsigned<D>> flowed_ = hn::Zero(bits_);
};

/// Radial return of the fibres of one section (Eq. 33-39); see return_section. `next` is a KeptStep or a CommittedStep.
template <int kDepthPoints, bool kHardening, class D, class Step>
HWY_INLINE LaneSectionSums<D> return_section(D d, const LaneMaterial<D>& material, const double* HWY_RESTRICT offset,
                                             const double* HWY_RESTRICT weight, hn::Vec<D> membrane, hn::Vec<D> bending,
                                             const Fibres& fibres, std::size_t first, Step& next) {
  const auto stretched = hn::Mul(material.modulus, membrane);
  const auto bent = hn::Mul(material.modulus, bending);
  LaneSectionSums<D> sums = {hn::Zero(d), hn::Zero(d), hn::Zero(d)};
  for (int i = 0; i < kDepthPoints; ++i) {
    const std::size_t fibre = first + static_cast<std::size_t>(i);
    const std::size_t place = fibre * fibres.stride;
    const auto trial =
        hn::Add(hn::LoadU(d, fibres.stress + place), hn::MulAdd(bent, hn::Set(d, offset[i]), stretched));  // Eq. 34
    hn::Vec<D> stress;
    hn::Vec<D> plastic_increment;
    if constexpr (kHardening) {
      const auto reduced = hn::Sub(trial, hn::LoadU(d, fibres.back_stress + place));  // Eq. 35
      const auto yield = hn::MulAdd(material.isotropic, hn::LoadU(d, fibres.plastic_strain + place),
                                    material.yield_stress);  // Eq. 33
      const auto clamped = hn::Max(hn::Min(reduced, yield), hn::Neg(yield));
      plastic_increment = hn::Mul(material.inverse, hn::Sub(reduced, clamped));  // Eq. 37, 38
      stress = hn::NegMulAdd(material.modulus, plastic_increment, trial);        // Eq. 36
    } else {
      stress = hn::Max(hn::Min(trial, material.yield_stress), hn::Neg(material.yield_stress));
      plastic_increment = hn::Sub(trial, stress);  // times E
    }
    next.put(fibre, stress, plastic_increment);
    const auto weighted = hn::Mul(hn::Set(d, weight[i]), stress);
    sums.axial = hn::Add(sums.axial, weighted);
    sums.moment = hn::MulAdd(weighted, hn::Set(d, offset[i]), sums.moment);
    sums.plastic_work = hn::MulAdd(weighted, plastic_increment, sums.plastic_work);
  }
  if constexpr (!kHardening) {
    sums.plastic_work = hn::Mul(material.inverse, sums.plastic_work);
  }
  return sums;
}

/// Makes the fibres remember a kept step.
template <bool kHardening, class D>
HWY_INLINE void commit_fibres(const LaneMaterial<D>& material, int count, const KeptStep<D>& kept,
                              const Fibres& fibres) {
  CommittedStep<kHardening, D> step(material, fibres);
  for (int i = 0; i < count; ++i) {
    step.put(static_cast<std::size_t>(i), kept.stress[i], kept.plastic_increment[i]);
  }
  step.finish();
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_SECTION_FIBRES_INL_H_

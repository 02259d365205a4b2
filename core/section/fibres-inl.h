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
  hn::Vec<D> inverse;              ///< 1 / (E + H)
  hn::Vec<D> isotropic;            ///< beta H
  hn::Vec<D> kinematic;            ///< (1 - beta) H
  hn::Vec<D> hardening;            ///< H
  hn::Vec<D> bending_flexibility;  ///< 12 / E: h times the curvature that a moment over b h^2 causes
};

template <class D>
struct LaneSectionSums {
  hn::Vec<D> axial;
  hn::Vec<D> moment;
  hn::Vec<D> plastic_work;
};

/// Makes an element's fibres remember a step (Eq. 39): what they remembered is read from `before` and written to `after`,
/// which may be the same.
template <bool kHardening, class D>
class FibreWriter {
 public:
  HWY_INLINE FibreWriter(const LaneMaterial<D>& material, const Fibres<hn::TFromD<D>>& before,
                         const Fibres<hn::TFromD<D>>& after)
      : material_(material), before_(before), after_(after) {}

  HWY_INLINE void put(std::size_t fibre, hn::Vec<D> stress, hn::Vec<D> increment) {
    const std::size_t from = fibre * before_.stride;
    const std::size_t to = fibre * after_.stride;
    hn::StoreU(stress, d_, after_.stress + to);
    if constexpr (kHardening) {
      const auto strain = hn::LoadU(d_, before_.plastic_strain + from);
      const auto back = hn::LoadU(d_, before_.back_stress + from);
      hn::StoreU(hn::Add(strain, hn::Abs(increment)), d_, after_.plastic_strain + to);
      hn::StoreU(hn::MulAdd(material_.kinematic, increment, back), d_, after_.back_stress + to);
    } else {
      const auto flows = hn::RebindMask(bits_, hn::Ne(increment, hn::Zero(d_)));
      flowed_ = hn::Or(flowed_, hn::IfThenElseZero(flows, hn::Set(bits_, Bits{1} << fibre)));
    }
  }

  HWY_INLINE void finish() {
    if constexpr (!kHardening) {
      hn::StoreU(hn::Or(flowed_, hn::LoadU(bits_, before_.flowed)), bits_, after_.flowed);
    }
  }

 private:
  using Bits = typename FibreMemory<hn::TFromD<D>>::Bits;

  static constexpr D d_{};
  static constexpr hn::RebindToUnsigned<D> bits_{};
  const LaneMaterial<D>& material_;
  const Fibres<hn::TFromD<D>>& before_;
  const Fibres<hn::TFromD<D>>& after_;
  hn::Vec<hn::RebindToUnsigned<D>> flowed_ = hn::Zero(bits_);
};

/// A copy of what the lanes' fibres remember, from which a step can be taken more than once.
template <int kFibres, bool kHardening, class D>
class FibreCopy {
 public:
  HWY_INLINE explicit FibreCopy(const Fibres<hn::TFromD<D>>& fibres) {
    for (int i = 0; i < kFibres; ++i) {
      const std::size_t from = static_cast<std::size_t>(i) * fibres.stride;
      hn::Store(hn::LoadU(d_, fibres.stress + from), d_, stress_ + i * kLanes);
      if constexpr (kHardening) {
        hn::Store(hn::LoadU(d_, fibres.back_stress + from), d_, back_stress_ + i * kLanes);
        hn::Store(hn::LoadU(d_, fibres.plastic_strain + from), d_, plastic_strain_ + i * kLanes);
      }
    }
    if constexpr (!kHardening) {
      hn::Store(hn::LoadU(bits_, fibres.flowed), bits_, flowed_);
    }
  }

  HWY_INLINE Fibres<hn::TFromD<D>> fibres() { return {stress_, back_stress_, plastic_strain_, flowed_, kLanes}; }

 private:
  using T = hn::TFromD<D>;

  static constexpr D d_{};
  static constexpr hn::RebindToUnsigned<D> bits_{};
  static constexpr std::size_t kLanes = hn::MaxLanes(D());
  static constexpr std::size_t kHardeningFibres = kHardening ? kFibres : 1;
  alignas(64) T stress_[kFibres * kLanes];
  alignas(64) T back_stress_[kHardeningFibres * kLanes];
  alignas(64) T plastic_strain_[kHardeningFibres * kLanes];
  alignas(64) typename FibreMemory<T>::Bits flowed_[kLanes];
};

/// Radial return of the fibres of one section (Eq. 33-39); see return_section.
template <int kDepthPoints, bool kHardening, class D>
HWY_INLINE LaneSectionSums<D> return_section(D d, const LaneMaterial<D>& material,
                                             const hn::TFromD<D>* HWY_RESTRICT offset,
                                             const hn::TFromD<D>* HWY_RESTRICT weight, hn::Vec<D> membrane,
                                             hn::Vec<D> bending, const Fibres<hn::TFromD<D>>& fibres, std::size_t first,
                                             FibreWriter<kHardening, D>& next) {
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

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_SECTION_FIBRES_INL_H_

// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_SECTION_RETURN_MAPPING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_SECTION_RETURN_MAPPING_INL_H_
#undef CELLCRUSH_SECTION_RETURN_MAPPING_INL_H_
#else
#define CELLCRUSH_SECTION_RETURN_MAPPING_INL_H_
#endif

#include <cstddef>

#include "section/fibre_history-inl.h"
#include "section/lane_material-inl.h"
#include "section/rule_factors.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Weighted sums over the fibres of a section: stress, stress times y / h (Eq. 28, E7), and the plastic work of the
/// step. In MPa; they are to be multiplied by b h, b h^2 and the volume.
template <class D>
struct SectionSums {
  Lane<D> axial;
  Lane<D> moment;
  Lane<D> plastic_work;

  HWY_INLINE SectionSums() : axial(0), moment(0), plastic_work(0) {}
};

/// Return mapping of the fibres of one section over a step (Eq. 33-39, E6). `first` is the index in the element of the
/// first fibre of the section. The history is read from `before` and written to `after`.
///
/// Strain increments are membrane + bending y / h (E5). `bending` is the increment of curvature times h, positive where
/// the left side stretches.
///
/// Deviation from the paper: the yield test and the plastic increment use the absolute value of the reduced stress. Eq.
/// 35-38 omit it, so a fibre in compression would never yield. There is no branch: the plastic increment follows from
/// the part of the reduced stress that the clamp to the yield surface removes.
template <bool kHardening, class Rule, class D>
HWY_INLINE SectionSums<D> return_map_section(const LaneMaterial<D>& material, const Rule& rule, Lane<D> membrane,
                                             Lane<D> bending, const Fibres<hn::TFromD<D>>& before, std::size_t first,
                                             FibreWriter<kHardening, D>& after) {
  const Lane<D> stretched = material.modulus * membrane;
  const Lane<D> bent = material.modulus * bending;
  SectionSums<D> sums;
  for (int i = 0; i < rule.depth_points(); ++i) {
    const std::size_t fibre = first + static_cast<std::size_t>(i);
    const std::size_t at = fibre * before.stride;
    const Lane<D> offset = rule.offset[i];
    const Lane<D> trial = Lane<D>::load(before.stress + at) + fma(bent, offset, stretched);  // Eq. 34, E6
    Lane<D> stress;
    Lane<D> increment;
    if constexpr (kHardening) {
      const Lane<D> reduced = trial - Lane<D>::load(before.back_stress + at);  // Eq. 35, E6
      const Lane<D> yield =
          fma(material.isotropic, Lane<D>::load(before.plastic_strain + at), material.yield_stress);  // Eq. 33, E6
      const Lane<D> clamped = max(min(reduced, yield), -yield);
      increment = material.inverse * (reduced - clamped);  // Eq. 37, 38, E6
      stress = fnma(material.modulus, increment, trial);   // Eq. 36, E6
    } else {
      stress = max(min(trial, material.yield_stress), -material.yield_stress);
      increment = trial - stress;  // times E
    }
    after.put(fibre, stress, increment);
    const Lane<D> weighted = Lane<D>(rule.depth_weight[i]) * stress;
    sums.axial += weighted;
    sums.moment = fma(weighted, offset, sums.moment);
    sums.plastic_work = fma(weighted, increment, sums.plastic_work);
  }
  if constexpr (!kHardening) {
    sums.plastic_work = material.inverse * sums.plastic_work;
  }
  return sums;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_SECTION_RETURN_MAPPING_INL_H_

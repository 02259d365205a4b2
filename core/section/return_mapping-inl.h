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

/// Weighted sums over the fibres of a section: stress, stress times its lever arm (Eq. 28, E7), and the plastic work of
/// the step. MPa.
template <class D>
struct SectionSums {
  Lane<D> axial;
  Lane<D> moment;
  Lane<D> plastic_work;

  HWY_INLINE SectionSums() : axial(0), moment(0), plastic_work(0) {}
};

/// Whether any of several numbers differ in any lane.
template <class D>
class Differences {
 public:
  HWY_INLINE Differences() : bits_(hn::Zero(D())) {}
  HWY_INLINE void note(Lane<D> a, Lane<D> b) { bits_ = hn::Or(bits_, hn::Xor(a.raw, b.raw)); }
  [[nodiscard]] HWY_INLINE bool none() const {
    const hn::RebindToUnsigned<D> bits;
    return hn::AllTrue(bits, hn::Eq(hn::BitCast(bits, bits_), hn::Zero(bits)));
  }

 private:
  hn::Vec<D> bits_;
};

/// Return mapping of the fibres of one section over a step (Eq. 33-39, E6). `first` is the index in the element of the
/// first fibre of the section.
///
/// The elastic stress increment of a fibre is stretched + bent * arm, MPa (E5): E times the increments of the membrane
/// strain and of the curvature. `arm` has the distance of each fibre from the axis, in the length with which the
/// curvature was multiplied: h, or the radius of gyration. `weighted_arm` has the same, times the weights through the
/// depth. The curvature is positive where the left side stretches.
///
/// Deviation from the paper: the yield test and the plastic increment use the absolute value of the reduced stress. Eq.
/// 35-38 omit it, so a fibre in compression would never yield. There is no branch: the plastic increment follows from
/// the part of the reduced stress that the clamp to the yield surface removes.
template <bool kHardening, class Rule, class D>
HWY_INLINE SectionSums<D> return_map_section(const LaneMaterial<D>& material, const Rule& rule,
                                             const typename Rule::Number* arm,
                                             const typename Rule::Number* weighted_arm, Lane<D> stretched, Lane<D> bent,
                                             const Fibres<hn::TFromD<D>>& fibres, std::size_t first,
                                             FibreWriter<kHardening, D>& next) {
  SectionSums<D> sums;
  Lane<D> trial[Rule::kDepthRoom];   // of Eq. 34, E6; with hardening, the reduced stress of Eq. 35
  Lane<D> mapped[Rule::kDepthRoom];  // the same within the yield surface
  Differences<D> yields;
  for (int i = 0; i < rule.depth_points(); ++i) {
    const std::size_t fibre = first + static_cast<std::size_t>(i);
    const std::size_t at = fibre * fibres.stride;
    trial[i] = fma(bent, Lane<D>(arm[i]), stretched) + Lane<D>::load(fibres.stress + at);
    Lane<D> stress;
    if constexpr (kHardening) {
      const Lane<D> back = Lane<D>::load(fibres.back_stress + at);
      trial[i] -= back;
      const Lane<D> yield =
          fma(material.isotropic, Lane<D>::load(fibres.plastic_strain + at), material.yield_stress);  // Eq. 33, E6
      mapped[i] = max(min(trial[i], yield), -yield);
      stress = fnma(material.elastic_share, trial[i] - mapped[i], trial[i]) + back;  // Eq. 36, E6
    } else {
      stress = mapped[i] = max(min(trial[i], material.yield_stress), -material.yield_stress);
    }
    next.put_stress(fibre, stress);
    yields.note(trial[i], mapped[i]);
    sums.axial = fma(Lane<D>(rule.depth_weight[i]), stress, sums.axial);
    sums.moment = fma(Lane<D>(weighted_arm[i]), stress, sums.moment);
  }
  if (yields.none()) {
    return sums;
  }
  FibreBits<D> of_section;
  const Lane<D> half_hardening = Lane<D>(hn::TFromD<D>(0.5)) * material.hardening;
  for (int i = 0; i < rule.depth_points(); ++i) {
    const std::size_t fibre = first + static_cast<std::size_t>(i);
    const Lane<D> increment = material.inverse * (trial[i] - mapped[i]);  // Eq. 37, 38, E6
    next.put_increment(fibre, increment);
    of_section.add(trial[i] != mapped[i], i);
    Lane<D> stress = Lane<D>::load(fibres.stress + fibre * fibres.stride);
    if constexpr (kHardening) {
      stress = fnma(half_hardening, increment, stress);  // mean of both yield surfaces, E10
    }
    sums.plastic_work = fma(Lane<D>(rule.depth_weight[i]) * stress, increment, sums.plastic_work);
  }
  next.put_yields(of_section, first);
  return sums;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_SECTION_RETURN_MAPPING_INL_H_

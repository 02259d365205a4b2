// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_SECTION_FIBRE_HISTORY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_SECTION_FIBRE_HISTORY_INL_H_
#undef CELLCRUSH_SECTION_FIBRE_HISTORY_INL_H_
#else
#define CELLCRUSH_SECTION_FIBRE_HISTORY_INL_H_
#endif

#include <cstddef>

#include "section/fibre_bits-inl.h"
#include "section/fibres.h"
#include "section/lane_material-inl.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Updates the history of the fibres of an element over a step (Eq. 39, E6).
template <bool kHardening, class D>
class FibreWriter {
 public:
  HWY_INLINE FibreWriter(const LaneMaterial<D>& material, const Fibres<hn::TFromD<D>>& fibres)
      : material_(material), fibres_(fibres) {}

  HWY_INLINE void put_stress(std::size_t fibre, Lane<D> stress) {
    stress.store(fibres_.stress + fibre * fibres_.stride);
  }

  /// Of a fibre that yields in some of the lanes. The increment is 0 in the others.
  HWY_INLINE void put_increment(std::size_t fibre, Lane<D> increment) {
    if constexpr (kHardening) {
      const std::size_t at = fibre * fibres_.stride;
      const Lane<D> strain = Lane<D>::load(fibres_.plastic_strain + at);
      const Lane<D> back = Lane<D>::load(fibres_.back_stress + at);
      (strain + abs(increment)).store(fibres_.plastic_strain + at);
      fma(material_.kinematic, increment, back).store(fibres_.back_stress + at);
    }
  }

  /// Fibres that yield in the section whose first fibre is `first`.
  HWY_INLINE void put_yields(const FibreBits<D>& of_section, std::size_t first) {
    yields_.add_section(of_section, first);
  }

  /// Fibres that have yielded in the step.
  [[nodiscard]] HWY_INLINE const FibreBits<D>& yields() const { return yields_; }

  HWY_INLINE void finish() const {
    if constexpr (!kHardening) {
      (yields_ | FibreBits<D>::load(fibres_.yielded)).store(fibres_.yielded);
    }
  }

 private:
  const LaneMaterial<D>& material_;
  const Fibres<hn::TFromD<D>>& fibres_;
  FibreBits<D> yields_;
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_SECTION_FIBRE_HISTORY_INL_H_

// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_SECTION_FIBRE_HISTORY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_SECTION_FIBRE_HISTORY_INL_H_
#undef CELLCRUSH_SECTION_FIBRE_HISTORY_INL_H_
#else
#define CELLCRUSH_SECTION_FIBRE_HISTORY_INL_H_
#endif

#include <cstddef>

#include "section/fibres.h"
#include "section/lane_material-inl.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Updates the history of the fibres of an element over a step (Eq. 39, E6). Reads it from `before` and writes it to
/// `after`, which may be the same.
template <bool kHardening, class D>
class FibreWriter {
 public:
  HWY_INLINE FibreWriter(const LaneMaterial<D>& material, const Fibres<hn::TFromD<D>>& before,
                         const Fibres<hn::TFromD<D>>& after)
      : material_(material), before_(before), after_(after) {}

  HWY_INLINE void put(std::size_t fibre, Lane<D> stress, Lane<D> increment) {
    const std::size_t from = fibre * before_.stride;
    const std::size_t to = fibre * after_.stride;
    stress.store(after_.stress + to);
    if constexpr (kHardening) {
      const Lane<D> strain = Lane<D>::load(before_.plastic_strain + from);
      const Lane<D> back = Lane<D>::load(before_.back_stress + from);
      (strain + abs(increment)).store(after_.plastic_strain + to);
      fma(material_.kinematic, increment, back).store(after_.back_stress + to);
    } else {
      const auto yields = hn::RebindMask(bits_, (increment != 0).raw);
      yielded_ = hn::Or(yielded_, hn::IfThenElseZero(yields, hn::Set(bits_, Bits{1} << fibre)));
    }
  }

  HWY_INLINE void finish() {
    if constexpr (!kHardening) {
      hn::StoreU(hn::Or(yielded_, hn::LoadU(bits_, before_.yielded)), bits_, after_.yielded);
    }
  }

 private:
  using Bits = typename FibreHistory<hn::TFromD<D>>::Bits;

  static constexpr hn::RebindToUnsigned<D> bits_{};
  const LaneMaterial<D>& material_;
  const Fibres<hn::TFromD<D>>& before_;
  const Fibres<hn::TFromD<D>>& after_;
  hn::Vec<hn::RebindToUnsigned<D>> yielded_ = hn::Zero(bits_);
};

/// A copy of the history of the fibres of the lanes, at most kRoom per element. A step can be repeated from it.
template <int kRoom, bool kHardening, class D>
class FibreCopy {
 public:
  HWY_INLINE FibreCopy(const Fibres<hn::TFromD<D>>& fibres, int count) {
    for (int i = 0; i < count; ++i) {
      const std::size_t from = static_cast<std::size_t>(i) * fibres.stride;
      hn::Store(hn::LoadU(d_, fibres.stress + from), d_, stress_ + i * kWidth);
      if constexpr (kHardening) {
        hn::Store(hn::LoadU(d_, fibres.back_stress + from), d_, back_stress_ + i * kWidth);
        hn::Store(hn::LoadU(d_, fibres.plastic_strain + from), d_, plastic_strain_ + i * kWidth);
      }
    }
    if constexpr (!kHardening) {
      hn::Store(hn::LoadU(bits_, fibres.yielded), bits_, yielded_);
    }
  }

  HWY_INLINE Fibres<hn::TFromD<D>> fibres() { return {stress_, back_stress_, plastic_strain_, yielded_, kWidth}; }

 private:
  using T = hn::TFromD<D>;

  static constexpr D d_{};
  static constexpr hn::RebindToUnsigned<D> bits_{};
  static constexpr std::size_t kWidth = Lane<D>::kWidth;
  static constexpr std::size_t kHardeningRoom = kHardening ? kRoom : 1;
  alignas(64) T stress_[kRoom * kWidth];
  alignas(64) T back_stress_[kHardeningRoom * kWidth];
  alignas(64) T plastic_strain_[kHardeningRoom * kWidth];
  alignas(64) typename FibreHistory<T>::Bits yielded_[kWidth];
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_SECTION_FIBRE_HISTORY_INL_H_

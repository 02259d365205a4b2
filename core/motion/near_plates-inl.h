// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_MOTION_NEAR_PLATES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_MOTION_NEAR_PLATES_INL_H_
#undef CELLCRUSH_MOTION_NEAR_PLATES_INL_H_
#else
#define CELLCRUSH_MOTION_NEAR_PLATES_INL_H_
#endif

#include <cstddef>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "simd/points-inl.h"
#include "touch/plate_forces.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Records the particles that may touch a plate at their new positions, and those with friction at a plate.
class NearPlatesNotes {
 public:
  /// REQUIRES: `near` has room for all recorded particles.
  NearPlatesNotes(const Scene& scene, const State& state, const PlateReach& reach, int* near)
      : below_(reach.below),
        above_(reach.above),
        along_x_(scene.plates.axis == 0),
        impact_friction_(state.impact_friction.empty() ? nullptr : state.impact_friction.data()),
        support_friction_(state.support_friction.data()),
        near_(near) {}

  template <class D>
  HWY_INLINE void note(const Points<D>& position, std::size_t i) {
    const Lane<D> along = along_x_ ? position.x : position.y;
    LaneMask<D> is_near = (along < below_) | (along > above_);
    if (impact_friction_ != nullptr) {
      is_near = is_near | (Lane<D>::load(impact_friction_ + i) != 0) | (Lane<D>::load(support_friction_ + i) != 0);
    }
    if (HWY_UNLIKELY(any(is_near))) {
      count_ += write_set_lanes(is_near, i, near_ + count_);
    }
  }

  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  const double below_;
  const double above_;
  const bool along_x_;
  const double* const impact_friction_;
  const double* const support_friction_;
  int* const near_;
  std::size_t count_ = 0;
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_MOTION_NEAR_PLATES_INL_H_

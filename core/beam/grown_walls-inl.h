// Included once for each target.
#if defined(CELLCRUSH_BEAM_GROWN_WALLS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_BEAM_GROWN_WALLS_INL_H_
#undef CELLCRUSH_BEAM_GROWN_WALLS_INL_H_
#else
#define CELLCRUSH_BEAM_GROWN_WALLS_INL_H_
#endif

#include <cstddef>

#include "beam/cross_section-inl.h"
#include "cellcrush/state.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Thickness of squashed elements in the arrays of the state (E5f), and what follows from it.
template <class D>
class GrownWalls {
  using Real = Lane<D>;

 public:
  explicit GrownWalls(State& state)
      : length_(state.length.data()),
        inverse_length_(state.inverse_length.data()),
        thickening_(state.thickening.data()),
        slope_(state.thickening_slope.data()),
        radius_growth_(state.radius_growth.data()) {}

  /// Greatest growth of half of an element's thickness by grow(), mm; not below 0.
  [[nodiscard]] HWY_INLINE double step() const { return greatest_of_lanes(step_); }

  /// What half of the thickness has grown by, mm.
  struct Growth {
    Real before;
    Real now;
  };

  /// Updates the thickness of elements that now have this length. REQUIRES: section.grows() now or before.
  HWY_INLINE Growth grow(const CrossSection<D>& section, std::ptrdiff_t element, Real length) {
    const Real before = Real::load(thickening_ + element);
    const Real now = section.thickening(length);
    now.store(thickening_ + element);
    section.slope_of_thickening(length, now).store(slope_ + element);
    step_ = max(step_, now - before);
    return {before, now};
  }

  /// Updates the radius of balls between two elements.
  HWY_INLINE void grow_balls(std::ptrdiff_t particle, std::ptrdiff_t element, std::ptrdiff_t next) const {
    (Real(0.5) * (Real::load(thickening_ + element) + Real::load(thickening_ + next))).store(radius_growth_ + particle);
  }

  /// Area of elements times their thickness over that before loading, mm^2.
  HWY_INLINE Real moment_area(const CrossSection<D>& section, std::ptrdiff_t element) const {
    const Real area = section.area(Real::load(inverse_length_ + element));
    if (section.constant_area) {
      return area;
    }
    const Real thickening = Real::load(thickening_ + element);
    return area * (Real(1) + (thickening + thickening) / section.thickness);
  }

  /// What the axial stress is more where the modulus falls with the length (E5g), MPa: dU/dl over A, with the stored
  /// energy U of n = `axial` and of the moments over A h, `left` and `right`. U at given stresses goes as 1 / E_l.
  HWY_INLINE Real stress_of_modulus(const CrossSection<D>& section, std::ptrdiff_t element, Real axial, Real left,
                                    Real right) const {
    const Real length = Real::load(length_ + element);
    if (none(section.is_squashed(length))) {
      return 0;
    }
    const Real thickening = section.constant_area ? Real(0) : Real::load(thickening_ + element);
    const Real slope = section.constant_area ? Real(0) : Real::load(slope_ + element);
    const Real bending = fma(left, left, fma(left, right, right * right));  // 4 of it are those of m over A gamma
    return fma(axial, axial, Real(4) * bending) *
           section.fall_of_modulus(length, Real::load(inverse_length_ + element), thickening, slope);
  }

 private:
  const double* const length_;
  const double* const inverse_length_;
  double* const thickening_;  // null at constant area, like those below
  double* const slope_;
  double* const radius_growth_;
  Real step_ = 0;
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_BEAM_GROWN_WALLS_INL_H_

// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_LAW_KINDS_MIXED_HARDENING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_LAW_KINDS_MIXED_HARDENING_INL_H_
#undef CELLCRUSH_LAW_KINDS_MIXED_HARDENING_INL_H_
#else
#define CELLCRUSH_LAW_KINDS_MIXED_HARDENING_INL_H_
#endif

#include <cstddef>

#include "law/fibre_law-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Bilinear, with linear isotropic and kinematic hardening (Eq. 33-39, E6).
///
/// Deviation from the paper: the yield test and the plastic increment use the absolute value of the reduced stress. Eq.
/// 35-38 omit it, so a fibre in compression would never yield. There is no branch: the plastic increment follows from
/// the part of the reduced stress that the clamp to the yield surface removes.
template <class D>
class FibreLaw<MixedHardening, D> {
  using T = hn::TFromD<D>;

 public:
  using Carried = NothingCarried;

  HWY_INLINE FibreLaw(const LaneMaterial<D>& material, double /*step*/) : material_(material) {}

  HWY_INLINE MappedFibre<D> map(Lane<D> trial, const Fibres<T>& fibres, std::size_t at, Carried& /*carried*/) const {
    const Lane<D> back = Lane<D>::load(fibres.back_stress + at);
    const Lane<D> reduced = trial - back;
    const Lane<D> yield =
        fma(material_.isotropic, Lane<D>::load(fibres.plastic_strain + at), material_.yield_stress);  // Eq. 33, E6
    const Lane<D> within = max(min(reduced, yield), -yield);
    return {reduced, within, fnma(material_.elastic_share, reduced - within, reduced) + back};  // Eq. 36, E6
  }
  HWY_INLINE Lane<D> increment(Lane<D> reduced, Lane<D> within) const {
    return material_.inverse * (reduced - within);  // Eq. 37, 38, E6
  }
  HWY_INLINE void flow(Lane<D> increment, Carried /*carried*/, const Fibres<T>& fibres, std::size_t at) const {
    const Lane<D> strain = Lane<D>::load(fibres.plastic_strain + at);
    const Lane<D> back = Lane<D>::load(fibres.back_stress + at);
    (strain + abs(increment)).store(fibres.plastic_strain + at);
    fma(material_.kinematic, increment, back).store(fibres.back_stress + at);  // Eq. 39, E6
  }
  /// Mean of both yield surfaces.
  HWY_INLINE Lane<D> dissipating(Lane<D> increment, Carried /*carried*/, const Fibres<T>& fibres,
                                 std::size_t at) const {
    return fnma(Lane<D>(T(0.5)) * material_.hardening, increment, Lane<D>::load(fibres.stress + at));
  }
  HWY_INLINE Lane<D> reduced(const Fibres<T>& fibres, std::size_t at) const {
    return Lane<D>::load(fibres.stress + at) - Lane<D>::load(fibres.back_stress + at);
  }
  HWY_INLINE Lane<D> tangent(Lane<D> added, const Fibres<T>& /*fibres*/, std::size_t /*at*/) const {
    return fma(material_.hardening, material_.inverse, added);
  }

 private:
  const LaneMaterial<D>& material_;
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_LAW_KINDS_MIXED_HARDENING_INL_H_

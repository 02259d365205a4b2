// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_LAW_KINDS_PERFECTLY_PLASTIC_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_LAW_KINDS_PERFECTLY_PLASTIC_INL_H_
#undef CELLCRUSH_LAW_KINDS_PERFECTLY_PLASTIC_INL_H_
#else
#define CELLCRUSH_LAW_KINDS_PERFECTLY_PLASTIC_INL_H_
#endif

#include <cstddef>

#include "law/fibre_law-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Elastic, then flow at the yield stress (E6 with H = 0).
template <class D>
class FibreLaw<PerfectlyPlastic, D> {
  using T = hn::TFromD<D>;

 public:
  using Carried = NothingCarried;

  HWY_INLINE FibreLaw(const LaneMaterial<D>& material, double /*step*/) : material_(material) {}

  HWY_INLINE MappedFibre<D> map(Lane<D> trial, const Fibres<T>& /*fibres*/, std::size_t /*at*/,
                                Carried& /*carried*/) const {
    const Lane<D> within = max(min(trial, material_.yield_stress), -material_.yield_stress);
    return {trial, within, within};
  }
  HWY_INLINE Lane<D> increment(Lane<D> reduced, Lane<D> within) const {
    return material_.inverse * (reduced - within);  // Eq. 37, 38, E6
  }
  HWY_INLINE void flow(Lane<D> /*increment*/, Carried /*carried*/, const Fibres<T>& /*fibres*/,
                       std::size_t /*at*/) const {}
  HWY_INLINE Lane<D> dissipating(Lane<D> /*increment*/, Carried /*carried*/, const Fibres<T>& fibres,
                                 std::size_t at) const {
    return Lane<D>::load(fibres.stress + at);
  }
  HWY_INLINE Lane<D> reduced(const Fibres<T>& fibres, std::size_t at) const {
    return Lane<D>::load(fibres.stress + at);
  }
  HWY_INLINE Lane<D> tangent(Lane<D> added, const Fibres<T>& /*fibres*/, std::size_t /*at*/) const { return added; }

 private:
  const LaneMaterial<D>& material_;
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_LAW_KINDS_PERFECTLY_PLASTIC_INL_H_

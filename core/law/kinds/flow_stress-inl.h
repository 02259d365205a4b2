// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_LAW_KINDS_FLOW_STRESS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_LAW_KINDS_FLOW_STRESS_INL_H_
#undef CELLCRUSH_LAW_KINDS_FLOW_STRESS_INL_H_
#else
#define CELLCRUSH_LAW_KINDS_FLOW_STRESS_INL_H_
#endif

#include <cstddef>

#include "law/fibre_law-inl.h"
#include "law/flow_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Yield stress along a curve of the plastic strain, times a factor of its rate (E6d, E6e). The plastic strain
/// increment of a step is the root of an increasing function, found in its logarithm: the curves rise as powers of it,
/// some with a vertical tangent at 0, and a power is a straight line there (E6f).
template <class D>
class FibreLaw<FlowStress, D> {
  using T = hn::TFromD<D>;

 public:
  struct Carried {
    Lane<D> back_change;
    Lane<D> mean;     ///< stress over the flow
    Lane<D> tangent;  ///< modulus over E
    Lane<D> flow;     ///< plastic strain increment, not below 0
  };

  HWY_INLINE FibreLaw(const LaneMaterial<D>& material, double step)
      : material_(material), inverse_step_(step > 0.0 ? static_cast<T>(1.0 / step) : T(0)) {}

  HWY_INLINE MappedFibre<D> map(Lane<D> trial, const Fibres<T>& fibres, std::size_t at, Carried& carried) const {
    const Lane<D> reduced = trial - Lane<D>::load(fibres.back_stress + at);
    carried = {0, 0, 0, 0};
    if (none(abs(reduced) > material_.yield_stress)) {
      return {reduced, reduced, trial};
    }
    return flow_from(trial, reduced, fibres, at, carried);
  }
  HWY_INLINE Lane<D> increment(Lane<D> reduced, Lane<D> within) const { return (reduced - within) / material_.modulus; }
  HWY_INLINE void flow(Lane<D> increment, const Carried& carried, const Fibres<T>& fibres, std::size_t at) const {
    const LaneMask<D> flows = increment != Lane<D>(0);
    (Lane<D>::load(fibres.plastic_strain + at) + abs(increment)).store(fibres.plastic_strain + at);
    (Lane<D>::load(fibres.back_stress + at) + carried.back_change).store(fibres.back_stress + at);
    select(flows, carried.tangent, Lane<D>::load(fibres.tangent + at)).store(fibres.tangent + at);
    select(flows, carried.flow, Lane<D>::load(fibres.flow + at)).store(fibres.flow + at);
  }
  HWY_INLINE Lane<D> dissipating(Lane<D> /*increment*/, const Carried& carried, const Fibres<T>& /*fibres*/,
                                 std::size_t /*at*/) const {
    return carried.mean;
  }
  HWY_INLINE Lane<D> reduced(const Fibres<T>& fibres, std::size_t at) const {
    return Lane<D>::load(fibres.stress + at) - Lane<D>::load(fibres.back_stress + at);
  }
  HWY_INLINE Lane<D> tangent(Lane<D> added, const Fibres<T>& fibres, std::size_t at) const {
    return Lane<D>::load(fibres.tangent + at) + added;
  }

 private:
  HWY_NOINLINE MappedFibre<D> flow_from(Lane<D> trial, Lane<D> reduced, const Fibres<T>& fibres, std::size_t at,
                                        Carried& carried) const {
    const FlowStressOf<D> stress(material_);
    const Lane<D> beta = material_.template parameter<&LawParameters::isotropic_fraction>();
    const Lane<D> strain = Lane<D>::load(fibres.plastic_strain + at);
    const Slope<D> now = stress.hardened(strain);
    const Lane<D> yield = fma(beta, now.value, material_.yield_stress);
    const LaneMask<D> flows = abs(reduced) > yield;
    if (none(flows)) {
      return {reduced, reduced, trial};
    }
    const FlowSearch<D> search(material_, stress, beta, inverse_step_);
    const Flow<D> flow = search.find(abs(reduced), yield, now, strain, Lane<D>::load(fibres.flow + at));
    const Lane<D> sign = select(reduced < Lane<D>(0), Lane<D>(-1), Lane<D>(1));
    const Lane<D> drop = masked(flows, sign * (material_.modulus * flow.increment));
    const Lane<D> within = reduced - drop;
    const LaneMask<D> counts = within != reduced;  // an increment below the rounding of the stress leaves no trace
    const Lane<D> after = trial - drop;
    const Lane<D> back = trial - reduced;
    const Lane<D> old = Lane<D>::load(fibres.stress + at);
    const Lane<D> before = fma(sign, max(yield, sign * (old - back)), back);  // where the flow begins
    carried.back_change = masked(counts, sign * ((Lane<D>(1) - beta) * flow.hardened));
    carried.mean = Lane<D>(T(0.5)) * (before + after);
    carried.tangent = flow.hardening;
    carried.flow = flow.increment;
    return {reduced, within, after};
  }

  const LaneMaterial<D>& material_;
  const Lane<D> inverse_step_;
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_LAW_KINDS_FLOW_STRESS_INL_H_

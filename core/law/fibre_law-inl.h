// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_LAW_FIBRE_LAW_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_LAW_FIBRE_LAW_INL_H_
#undef CELLCRUSH_LAW_FIBRE_LAW_INL_H_
#else
#define CELLCRUSH_LAW_FIBRE_LAW_INL_H_
#endif

#include "law/fibres.h"
#include "law/lane_material-inl.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// A fibre after the elastic trial step: its reduced stress (Eq. 35), the same within the yield surface, and the stress
/// that it returns to. The fibre yields where the first two differ. MPa.
template <class D>
struct MappedFibre {
  Lane<D> reduced;
  Lane<D> within;
  Lane<D> stress;
};

/// The equations of a law (cellcrush/laws.h) for the fibres of the lanes; one file a law specializes it:
///
///   FibreLaw(material, step)        constants of the lanes' materials, and the time step, s
///   map(trial, fibres, at)          return mapping of the elastic trial stress; `at`: place of the fibre in the arrays
///   increment(reduced, within)      plastic strain increment; 0 where the fibre stays elastic
///   flow(increment, fibres, at)     updates the arrays that the law keeps, other than the stress
///   dissipating(stress, increment)  mean stress over the step by which the increment dissipates (E10)
///   reduced(fibres, at)             reduced stress before the step
///   tangent(added)                  tangent modulus of a yielding fibre over E, plus `added`
///
/// The stored energy is that of the stress, sigma^2 / 2E, for every law (energy/energy_kernels.h).
template <class Law, class D>
class FibreLaw;

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#include "law/mixed_hardening-inl.h"
#include "law/perfectly_plastic-inl.h"

#endif  // CELLCRUSH_LAW_FIBRE_LAW_INL_H_

// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_LAW_FLOW_SEARCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_LAW_FLOW_SEARCH_INL_H_
#undef CELLCRUSH_LAW_FLOW_SEARCH_INL_H_
#else
#define CELLCRUSH_LAW_FLOW_SEARCH_INL_H_
#endif

#include <limits>

#include "law/flow_curve-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// How fibres flow in a step beyond their yield surface at rest.
template <class D>
struct Flow {
  Lane<D> increment;  ///< of the plastic strain, above 0
  Lane<D> hardened;   ///< change of the curve, MPa
  Lane<D> hardening;  ///< tangent modulus over E
};

/// The plastic strain increment of a step is the root of an increasing function: what the trial stress loses by it is
/// what it was beyond the yield surface at rest (E6f). It is found in its logarithm: the curves rise as powers of it,
/// some with a vertical tangent at 0, and a power is a straight line there.
template <class D>
class FlowSearch {
  using T = hn::TFromD<D>;

 public:
  /// Keeps references. `beta`: isotropic fraction; `inverse_step`: 1 over the time step, 1/s; 0 without a time step.
  HWY_INLINE FlowSearch(const LaneMaterial<D>& material, const FlowStressOf<D>& stress, Lane<D> beta,
                        Lane<D> inverse_step)
      : material_(material), stress_(stress), beta_(beta), inverse_step_(inverse_step) {}

  /// Of the lanes whose reduced trial stresses are of a size above the yield stress at rest, MPa; with accumulated
  /// plastic strains, and `now` at these strains. `last`: increment of their last flow, from which the search of a law
  /// of the rate begins. Of the other lanes nothing is said.
  HWY_INLINE Flow<D> find(Lane<D> size, Lane<D> yield, const Slope<D>& now, Lane<D> strain, Lane<D> last) const {
    const LaneMask<D> flows = size > yield;
    Flow<D> flow = {0, 0, 0};
    const Lane<D> excess = select(flows, size - yield, Lane<D>(1));
    Lane<D> low = 0;
    Lane<D> high = excess / material_.modulus;
    Lane<D> increment = first_guess(excess, strain, now.slope, last, high);
    const Lane<D> tolerance = Lane<D>(T(kTolerance)) * size;
    LaneMask<D> open = flows;
    for (int i = 0; any(open); ++i) {
      const Loss loss = loss_by(increment, strain, yield, now.value);
      const Lane<D> off = loss.value - excess;
      high = select(off > Lane<D>(0), increment, high);
      low = select(off < Lane<D>(0), increment, low);
      const Lane<D> next = increment * step_in_logarithm(excess, loss, open);
      const LaneMask<D> is_within = (next > low) & (next < high);
      LaneMask<D> ends = abs(off) <= max(Lane<D>(T(kClose)) * loss.by_logarithm, tolerance);
      if (i == kMostIterations) {
        ends = ends | open;
      }
      ends = ends & open;
      const Lane<D> found = select(is_within, next, increment);
      flow.increment = select(ends, found, flow.increment);
      flow.hardened = select(ends, fma(loss.curve.slope, found - increment, loss.curve.value), flow.hardened);
      flow.hardening =
          select(ends, fnma(material_.modulus, increment, loss.by_logarithm) / loss.by_logarithm, flow.hardening);
      open = open & !ends;
      const Lane<D> between = select(low > Lane<D>(0), sqrt(low * high), Lane<D>(T(1e-3)) * high);
      increment = select(open, select(is_within, next, between), increment);
    }
    return flow;
  }

 private:
  static constexpr int kMostIterations = 60;
  /// Error of the increment over itself from which one more step ends the search: it leaves the square of that.
  static constexpr double kClose = 5e-5;
  /// Error of the stress over itself at which the search ends in any case.
  static constexpr double kTolerance = 1e-10;

  /// What the trial stress loses by an increment beyond the yield surface at rest, MPa.
  struct Loss {
    Lane<D> value;
    Lane<D> by_logarithm;  ///< its derivative by the logarithm of the increment
    Slope<D> curve;        ///< change of the curve
  };

  HWY_INLINE Loss loss_by(Lane<D> increment, Lane<D> strain, Lane<D> yield, Lane<D> hardened) const {
    Loss loss;
    loss.curve = stress_.hardened(strain + increment);
    loss.curve.value -= hardened;
    const Slope<D> factor = stress_.hastened(max(increment * inverse_step_, Lane<D>(std::numeric_limits<T>::min())));
    const Lane<D> surface = fma(beta_, loss.curve.value, yield);
    const Lane<D> slope = fma(loss.curve.slope, fma(beta_, factor.value, Lane<D>(1)), material_.modulus);
    loss.value = fma(surface, factor.value, fma(material_.modulus, increment, loss.curve.value));
    loss.by_logarithm = fma(surface, factor.slope, increment * slope);
    return loss;
  }

  /// The tangent of a curve that is smooth over an increment; of others and of laws of the rate the last increment.
  HWY_INLINE Lane<D> first_guess(Lane<D> excess, Lane<D> strain, Lane<D> slope, Lane<D> last, Lane<D> high) const {
    const Lane<D> known = select((last > Lane<D>(0)) & (last < high), last, high);
    const LaneMask<D> is_smooth = (strain > high) & !stress_.has_rate();
    return select(is_smooth, excess / (material_.modulus + slope), known);
  }

  /// Factor of an increment by a step of Newton's method for ln(loss) over ln(increment). Near the root by a fraction
  /// that has logarithm and exponential to the third order.
  HWY_INLINE Lane<D> step_in_logarithm(Lane<D> excess, const Loss& loss, LaneMask<D> wanted) const {
    const Lane<D> off = excess - loss.value;
    const Lane<D> sum = excess + loss.value;
    const Lane<D> half_turn = off * loss.value;
    const Lane<D> over = sum * loss.by_logarithm;
    const Lane<D> near = (over + half_turn) / (over - half_turn);
    const LaneMask<D> is_near =
        ((abs(half_turn) < Lane<D>(T(0.1)) * over) & (abs(off) < Lane<D>(T(0.1)) * sum)) | !wanted;
    if (all(is_near)) {
      return near;
    }
    return select(is_near, near, exponential(logarithm(excess / loss.value) * (loss.value / loss.by_logarithm)));
  }

  const LaneMaterial<D>& material_;
  const FlowStressOf<D>& stress_;
  const Lane<D> beta_;
  const Lane<D> inverse_step_;
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_LAW_FLOW_SEARCH_INL_H_

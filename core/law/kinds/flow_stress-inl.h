// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_LAW_KINDS_FLOW_STRESS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_LAW_KINDS_FLOW_STRESS_INL_H_
#undef CELLCRUSH_LAW_KINDS_FLOW_STRESS_INL_H_
#else
#define CELLCRUSH_LAW_KINDS_FLOW_STRESS_INL_H_
#endif

#include <cstddef>
#include <limits>

#include "law/fibre_law-inl.h"
#include "simd/functions-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// A value and its derivative.
template <class D>
struct Slope {
  Lane<D> value;
  Lane<D> slope;
};

/// The bent line of the lanes' materials (cellcrush/scene.h).
template <class D>
HWY_INLINE Slope<D> point_of(const LaneMaterials<D>& of, BentLine Material::*line, Lane<D> at) {
  using T = hn::TFromD<D>;
  constexpr T kNever = std::numeric_limits<T>::infinity();
  Slope<D> point = {0, 0};
  const std::size_t count = of.greatest([line](const Material& material) { return (material.*line).edges.size(); });
  if (count == 0) {
    return point;
  }
  const Lane<D> end = of.load([line](const Material& material) { return (material.*line).end; });
  const LaneMask<D> ended = at >= end;
  const Lane<D> within = min(at, end);
  for (std::size_t i = 0; i < count; ++i) {
    const Lane<D> edge = of.load([line, i](const Material& material) {
      const BentLine& bent = material.*line;
      return i < bent.edges.size() ? bent.edges[i] : kNever;
    });
    const Lane<D> bend = of.load([line, i](const Material& material) {
      const BentLine& bent = material.*line;
      return i < bent.bends.size() ? bent.bends[i] : 0.0;
    });
    const LaneMask<D> past = within >= edge;
    point.value = fma(bend, masked(past, within - edge), point.value);
    point.slope += masked(past & !ended, bend);
  }
  const Lane<D> exponent = of.load([line](const Material& material) { return (material.*line).exponent; });
  const LaneMask<D> rises_on = ended & (exponent > Lane<D>(0));
  if (any(rises_on)) {
    const Lane<D> last = of.load([line](const Material& material) { return (material.*line).last; });
    const Lane<D> stress = last * power(select(rises_on, at / end, Lane<D>(1)), exponent);
    point.value += masked(rises_on, stress - last);
    point.slope += masked(rises_on, stress * exponent / at);
  }
  return point;
}

/// The yield stress of the lanes' materials: curve of the plastic strain at rest (E6d), and factor of its rate (E6e).
template <class D>
class FlowStressOf {
  using T = hn::TFromD<D>;

 public:
  HWY_INLINE explicit FlowStressOf(const LaneMaterial<D>& material)
      : material_(material),
        voce_(material.template parameter<&LawParameters::voce_stress_mpa>()),
        ludwik_(material.template parameter<&LawParameters::ludwik_stress_mpa>()),
        symonds_rate_(material.template parameter<&LawParameters::cowper_symonds_rate_per_s>()),
        symonds_inverse_(Lane<D>(1) /
                         max(material.template parameter<&LawParameters::cowper_symonds_exponent>(), Lane<D>(1))) {}

  /// Increase of the yield stress at rest.
  [[nodiscard]] HWY_INLINE Slope<D> hardened(Lane<D> strain) const {
    Slope<D> point = point_of(material_.materials, &Material::hardening, strain);
    point.value = fma(material_.hardening, strain, point.value);
    point.slope += material_.hardening;
    if (any(voce_ > Lane<D>(0))) {
      const Lane<D> exponent = material_.template parameter<&LawParameters::voce_exponent>();
      const Lane<D> left = voce_ * exponential(-exponent * strain);
      point.value += voce_ - left;
      point.slope = fma(exponent, left, point.slope);
    }
    if (any(ludwik_ > Lane<D>(0))) {
      const Lane<D> exponent = material_.template parameter<&LawParameters::ludwik_exponent>();
      const Lane<D> above = max(strain, Lane<D>(std::numeric_limits<T>::min()));
      const Lane<D> increase = ludwik_ * power(above, exponent);
      point.value += masked(strain > Lane<D>(0), increase);
      point.slope = fma(exponent, increase / above, point.slope);
    }
    return point;
  }

  /// Factor of the yield stress less 1 at a rate above 0, and its derivative by the rate.
  [[nodiscard]] HWY_INLINE Slope<D> hastened(Lane<D> rate) const {
    Slope<D> point = {0, 0};
    const LaneMask<D> is_symonds = symonds_rate_ > Lane<D>(0);
    if (any(is_symonds)) {
      const Lane<D> factor =
          masked(is_symonds, power(rate / select(is_symonds, symonds_rate_, Lane<D>(1)), symonds_inverse_));
      point = {factor, factor * symonds_inverse_ / rate};
    }
    if (has_logarithm()) {
      const Slope<D> bent = point_of(material_.materials, &Material::rate, logarithm(rate));
      point.value += bent.value;
      point.slope += bent.slope / rate;
    }
    return point;
  }

 private:
  [[nodiscard]] bool has_logarithm() const {
    return material_.materials.greatest([](const Material& material) { return material.rate.edges.size(); }) > 0;
  }

  const LaneMaterial<D>& material_;
  const Lane<D> voce_;
  const Lane<D> ludwik_;
  const Lane<D> symonds_rate_;
  const Lane<D> symonds_inverse_;
};

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
  HWY_INLINE Lane<D> increment(Lane<D> reduced, Lane<D> within) const {
    return (reduced - within) / material_.modulus;
  }
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
  static constexpr int kMostIterations = 60;
  /// Error of the stress over itself at which the search ends.
  static constexpr double kTolerance = 1e-10;

  /// Of an increment: what the trial stress loses by it beyond the yield surface at rest, by its derivative; and the
  /// change of the curve.
  struct Loss {
    Slope<D> whole;
    Slope<D> curve;
  };

  HWY_NOINLINE MappedFibre<D> flow_from(Lane<D> trial, Lane<D> reduced, const Fibres<T>& fibres, std::size_t at,
                                        Carried& carried) const {
    const FlowStressOf<D> stress(material_);
    const Lane<D> beta = material_.template parameter<&LawParameters::isotropic_fraction>();
    const Lane<D> strain = Lane<D>::load(fibres.plastic_strain + at);
    const Slope<D> now = stress.hardened(strain);
    const Lane<D> yield = fma(beta, now.value, material_.yield_stress);
    const Lane<D> size = abs(reduced);
    const LaneMask<D> flows = size > yield;
    if (none(flows)) {
      return {reduced, reduced, trial};
    }
    const Lane<D> excess = select(flows, size - yield, Lane<D>(1));
    const auto loss_by = [&](Lane<D> increment) HWY_ATTR {
      Loss loss;
      loss.curve = stress.hardened(strain + increment);
      loss.curve.value -= now.value;
      const Slope<D> factor = stress.hastened(max(increment * inverse_step_, Lane<D>(std::numeric_limits<T>::min())));
      const Lane<D> surface = fma(beta, loss.curve.value, yield);
      loss.whole.value = fma(surface, factor.value, fma(material_.modulus, increment, loss.curve.value));
      loss.whole.slope = fma(surface * inverse_step_, factor.slope,
                             fma(loss.curve.slope, fma(beta, factor.value, Lane<D>(1)), material_.modulus));
      return loss;
    };
    Lane<D> low = 0;
    Lane<D> high = excess / material_.modulus;
    const Lane<D> last = Lane<D>::load(fibres.flow + at);
    Lane<D> increment = select((last > low) & (last < high), last, high);
    const Lane<D> tolerance = Lane<D>(T(kTolerance)) * size;
    Loss loss = loss_by(increment);
    for (int i = 0; i < kMostIterations; ++i) {
      const Lane<D> off = loss.whole.value - excess;
      const LaneMask<D> done = (abs(off) <= tolerance) | !flows;
      if (all(done)) {
        break;
      }
      high = select(off > Lane<D>(0), increment, high);
      low = select(off < Lane<D>(0), increment, low);
      const Lane<D> next = increment * step_in_logarithm(excess, loss.whole, increment, !done);
      const Lane<D> between = select(low > Lane<D>(0), sqrt(low * high), Lane<D>(T(1e-3)) * high);
      const Lane<D> inside = select((next > low) & (next < high), next, between);
      increment = select(done, increment, inside);
      loss = loss_by(increment);
    }
    const Lane<D> old = Lane<D>::load(fibres.stress + at);
    return returned(trial, reduced, old, increment, flows, beta, yield, loss, carried);
  }

  /// Factor of an increment by a step of Newton's method for ln(loss) over ln(increment). Near the root by fractions
  /// that have logarithm and exponential to the third order.
  HWY_INLINE Lane<D> step_in_logarithm(Lane<D> excess, const Slope<D>& loss, Lane<D> increment,
                                       LaneMask<D> wanted) const {
    const Lane<D> inverse_power = loss.value / (increment * loss.slope);
    const Lane<D> ratio = excess / loss.value;
    const Lane<D> two = 2;
    const Lane<D> third = (ratio - Lane<D>(1)) / (ratio + Lane<D>(1));
    const Lane<D> turn = two * third * inverse_power;
    const Lane<D> near = (two + turn) / (two - turn);
    const LaneMask<D> is_near = ((abs(turn) < Lane<D>(T(0.2))) & (abs(third) < Lane<D>(T(0.1)))) | !wanted;
    return all(is_near) ? near : select(is_near, near, exponential(logarithm(ratio) * inverse_power));
  }

  HWY_INLINE MappedFibre<D> returned(Lane<D> trial, Lane<D> reduced, Lane<D> old, Lane<D> increment, LaneMask<D> flows,
                                     Lane<D> beta, Lane<D> yield, const Loss& loss, Carried& carried) const {
    const Lane<D> sign = select(reduced < Lane<D>(0), Lane<D>(-1), Lane<D>(1));
    const Lane<D> drop = masked(flows, sign * (material_.modulus * increment));
    const Lane<D> within = reduced - drop;
    const LaneMask<D> counts = within != reduced;  // an increment below the rounding of the stress leaves no trace
    const Lane<D> hardening = loss.whole.slope - material_.modulus;
    const Lane<D> after = trial - drop;
    const Lane<D> back = trial - reduced;
    const Lane<D> before = fma(sign, max(yield, sign * (old - back)), back);  // where the flow begins
    carried.back_change = masked(counts, sign * ((Lane<D>(1) - beta) * loss.curve.value));
    carried.mean = Lane<D>(T(0.5)) * (before + after);
    carried.tangent = hardening / loss.whole.slope;
    carried.flow = increment;
    return {reduced, within, after};
  }

  const LaneMaterial<D>& material_;
  const Lane<D> inverse_step_;
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_LAW_KINDS_FLOW_STRESS_INL_H_

// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_LAW_FLOW_CURVE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_LAW_FLOW_CURVE_INL_H_
#undef CELLCRUSH_LAW_FLOW_CURVE_INL_H_
#else
#define CELLCRUSH_LAW_FLOW_CURVE_INL_H_
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
                         max(material.template parameter<&LawParameters::cowper_symonds_exponent>(), Lane<D>(1))),
        has_logarithm_(material.materials.load([](const Material& of) HWY_ATTR {
          return of.rate.edges.empty() ? 0.0 : 1.0;
        }) > Lane<D>(0)) {}

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

  /// Factor of the yield stress less 1 at a rate above 0, and its derivative by the logarithm of the rate.
  [[nodiscard]] HWY_INLINE Slope<D> hastened(Lane<D> rate) const {
    Slope<D> point = {0, 0};
    const LaneMask<D> is_symonds = symonds_rate_ > Lane<D>(0);
    if (any(is_symonds)) {
      const Lane<D> factor =
          masked(is_symonds, power(rate / select(is_symonds, symonds_rate_, Lane<D>(1)), symonds_inverse_));
      point = {factor, factor * symonds_inverse_};
    }
    if (any(has_logarithm_)) {
      const Slope<D> bent = point_of(material_.materials, &Material::rate, logarithm(rate));
      point.value += bent.value;
      point.slope += bent.slope;
    }
    return point;
  }

  /// Lanes whose yield stress depends on the rate.
  [[nodiscard]] HWY_INLINE LaneMask<D> has_rate() const { return has_logarithm_ | (symonds_rate_ > Lane<D>(0)); }

 private:
  const LaneMaterial<D>& material_;
  const Lane<D> voce_;
  const Lane<D> ludwik_;
  const Lane<D> symonds_rate_;
  const Lane<D> symonds_inverse_;
  const LaneMask<D> has_logarithm_;
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_LAW_FLOW_CURVE_INL_H_

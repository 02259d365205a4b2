// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_BEAM_SECTION_FLEXIBILITY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_BEAM_SECTION_FLEXIBILITY_INL_H_
#undef CELLCRUSH_BEAM_SECTION_FLEXIBILITY_INL_H_
#else
#define CELLCRUSH_BEAM_SECTION_FLEXIBILITY_INL_H_
#endif

#include <cstddef>

#include "law/fibre_law-inl.h"
#include "section/fibre_bits-inl.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// What is added to the tangent modulus of a fibre that yields, over the elastic one (E5d). A perfectly plastic fibre
/// has none, and a section of such fibres would be infinitely flexible.
inline constexpr double kAddedTangent = 0.01;

/// Stresses of a section over its area, MPa (E5b): n = N / A and m = M / (A gamma), with the radius of gyration gamma.
/// The same numbers are elastic strains times E: n = E e, m = E gamma kappa.
template <class D>
struct SectionForce {
  Lane<D> axial;   ///< n
  Lane<D> moment;  ///< m
};

template <class D>
HWY_INLINE SectionForce<D> operator-(const SectionForce<D>& a, const SectionForce<D>& b) {
  return {a.axial - b.axial, a.moment - b.moment};
}

/// Flexibility of a section over that of an elastic one (E5d): a symmetric 2 x 2 matrix, the unit matrix while elastic.
template <class D>
struct SectionFlexibility {
  Lane<D> axial;
  Lane<D> mixed;
  Lane<D> bending;

  /// Strains times E that belong to a change of the forces.
  [[nodiscard]] HWY_INLINE SectionForce<D> strains_of(const SectionForce<D>& force) const {
    return {fma(axial, force.axial, mixed * force.moment), fma(mixed, force.axial, bending * force.moment)};
  }
};

/// Flexibility of the section whose fibres `is_soft(fibre)` yield; the others are elastic.
template <class Law, class Rule, class D, class IsSoft>
HWY_INLINE SectionFlexibility<D> flexibility_of(const Rule& rule, const FibreLaw<Law, D>& law, const IsSoft& is_soft) {
  Lane<D> area = 0;
  Lane<D> first = 0;
  Lane<D> second = 0;
  for (int j = 0; j < rule.depth_points(); ++j) {
    const LaneMask<D> soft = is_soft(j);
    area = select(soft, area + Lane<D>(rule.depth_weight[j]), area);
    first = select(soft, first + Lane<D>(rule.arm_weight[j]), first);
    second = select(soft, second + Lane<D>(rule.square_weight[j]), second);
  }
  const Lane<D> one = 1;
  const Lane<D> lost = one - law.tangent(Lane<D>(hn::TFromD<D>(kAddedTangent)));
  const Lane<D> axial = fnma(lost, area, one);  // stiffness
  const Lane<D> mixed = lost * first;           // with the opposite sign
  const Lane<D> bending = fnma(lost, second, one);
  const Lane<D> inverse = one / fms(axial, bending, mixed * mixed);
  return {inverse * bending, inverse * mixed, inverse * axial};
}

/// Flexibility of a section in the coming step: of the fibres that yielded in the last one, those are soft which its
/// strains would drive further. `first` is the first fibre of the section, `yielding` has its own bits, and `strains`
/// are those that it would have if it were elastic.
template <class Law, class Rule, class D>
HWY_INLINE SectionFlexibility<D> look_ahead(const Rule& rule, const FibreLaw<Law, D>& law,
                                            const Fibres<hn::TFromD<D>>& fibres, const FibreBits<D>& yielding,
                                            std::size_t first, const SectionForce<D>& strains) {
  return flexibility_of(rule, law, [&](int j) HWY_ATTR {
    const Lane<D> reduced = law.reduced(fibres, (first + j) * fibres.stride);
    const Lane<D> strain = fma(Lane<D>(rule.arm[j]), strains.moment, strains.axial);
    return yielding.has(j) & (reduced * strain > 0);
  });
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_BEAM_SECTION_FLEXIBILITY_INL_H_

// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_BEAM_FORCE_BALANCE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_BEAM_FORCE_BALANCE_INL_H_
#undef CELLCRUSH_BEAM_FORCE_BALANCE_INL_H_
#else
#define CELLCRUSH_BEAM_FORCE_BALANCE_INL_H_
#endif

#include <cstddef>

#include "beam/elastic_element-inl.h"
#include "law/fibre_law-inl.h"
#include "section/return_mapping-inl.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// What is added to the tangent modulus of a fibre that yields, over the elastic one (E5d). A perfectly plastic fibre
/// has none, and a section of such fibres would be infinitely flexible.
inline constexpr double kAddedTangent = 0.02;

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

/// Flexibility of the section whose fibres `is_soft(fibre)` yield; the others are elastic. `first` is the first of its
/// fibres.
template <class Law, class Rule, class D, class IsSoft>
HWY_INLINE SectionFlexibility<D> flexibility_of(const Rule& rule, const FibreLaw<Law, D>& law,
                                                const Fibres<hn::TFromD<D>>& fibres, std::size_t first,
                                                const IsSoft& is_soft) {
  const Lane<D> one = 1;
  const auto lost_by = [&](int j) HWY_ATTR {
    return one - law.tangent(Lane<D>(hn::TFromD<D>(kAddedTangent)), fibres, (first + j) * fibres.stride);
  };
  Lane<D> area = 0;
  Lane<D> moment = 0;
  Lane<D> second = 0;
  for (int j = 0; j < rule.depth_points(); ++j) {
    const LaneMask<D> soft = is_soft(j);
    if constexpr (Law::kFacts.keeps_tangent) {
      const Lane<D> lost = masked(soft, lost_by(j));
      area = fma(lost, Lane<D>(rule.depth_weight[j]), area);
      moment = fma(lost, Lane<D>(rule.arm_weight[j]), moment);
      second = fma(lost, Lane<D>(rule.square_weight[j]), second);
    } else {
      area = select(soft, area + Lane<D>(rule.depth_weight[j]), area);
      moment = select(soft, moment + Lane<D>(rule.arm_weight[j]), moment);
      second = select(soft, second + Lane<D>(rule.square_weight[j]), second);
    }
  }
  const Lane<D> lost = Law::kFacts.keeps_tangent ? one : lost_by(0);
  const Lane<D> axial = fnma(lost, area, one);  // stiffness
  const Lane<D> mixed = lost * moment;          // with the opposite sign
  const Lane<D> bending = fnma(lost, second, one);
  const Lane<D> inverse = one / fms(axial, bending, mixed * mixed);
  return {inverse * bending, inverse * mixed, inverse * axial};
}

/// Flexibility of a section in the coming step: of the fibres that yielded in the last one, those are soft which its
/// strains would drive further. `yielding` has the section's own bits, and `strains` are those that it would have if it
/// were elastic.
template <class Law, class Rule, class D>
HWY_INLINE SectionFlexibility<D> look_ahead(const Rule& rule, const FibreLaw<Law, D>& law,
                                            const Fibres<hn::TFromD<D>>& fibres, const FibreBits<D>& yielding,
                                            std::size_t first, const SectionForce<D>& strains) {
  return flexibility_of(rule, law, fibres, first, [&](int j) HWY_ATTR {
    const Lane<D> reduced = law.reduced(fibres, (first + j) * fibres.stride);
    const Lane<D> strain = fma(Lane<D>(rule.arm[j]), strains.moment, strains.axial);
    return yielding.has(j) & (reduced * strain > 0);
  });
}

/// Forces of a unit, which is solved at once: an element, or two whose common node has no rotation of its own, so that
/// the moment is continuous there (E5b). The axial force of each element over A; its outer moment, at the end of the
/// unit, over A gamma; and the shared moment, at the common node or, of one element, at its end. MPa, positive where
/// the left side is stretched.
template <int kElements, class D>
struct UnitForces {
  Lane<D> axial[kElements];
  Lane<D> outer[kElements];
  Lane<D> shared;

  static HWY_INLINE UnitForces none() {
    UnitForces forces;
    for (int e = 0; e < kElements; ++e) {
      forces.axial[e] = forces.outer[e] = 0;
    }
    forces.shared = 0;
    return forces;
  }
};

template <int kElements, class D>
HWY_INLINE UnitForces<kElements, D> select(LaneMask<D> mask, const UnitForces<kElements, D>& yes,
                                           const UnitForces<kElements, D>& no) {
  UnitForces<kElements, D> forces;
  for (int e = 0; e < kElements; ++e) {
    forces.axial[e] = select(mask, yes.axial[e], no.axial[e]);
    forces.outer[e] = select(mask, yes.outer[e], no.outer[e]);
  }
  forces.shared = select(mask, yes.shared, no.shared);
  return forces;
}

/// Strains of a step that are work-conjugate to the forces, MPa: E_l times stretch over length, E_l gamma times turn
/// over length, and for the shared turn E gamma.
template <int kElements, class D>
using UnitStrains = UnitForces<kElements, D>;

/// Equations of an element: flexibility times forces = strains (E5b). n is the axial force, o the outer and s the
/// shared moment; `of_` are the right-hand sides.
template <class D>
struct ElementEquations {
  Lane<D> nn, no, ns, oo, os, ss;
  Lane<D> of_n, of_o, of_s;
};

/// Sections of the elements of a unit with their flexibilities, and the forces that they bear.
template <int kElements, class Rule, class D>
class UnitSections {
  static constexpr int kRoom = Rule::kSectionRoom;

 public:
  /// Keeps references.
  HWY_INLINE UnitSections(const Rule& rule, const ElasticElement<D>& elastic) : rule_(rule), elastic_(elastic) {}

  SectionForce<D> force[kElements][kRoom];
  /// Only of the sections that are marked in `soft`; the others are elastic in all lanes.
  SectionFlexibility<D> flexibility[kElements][kRoom];
  unsigned soft[kElements] = {};
  /// E / E_l of the elements: above 1 where they are compressed (E5c).
  Lane<D> compression[kElements];
  /// Outer moment less the shared one that the shear of an element bears (E5i); only if it shears.
  Lane<D> sheared[kElements];

  [[nodiscard]] HWY_INLINE bool shears() const { return elastic_.shears; }

  /// The elements take up the shear under the forces of the unit, which are whole in unsettled lanes and otherwise
  /// changes. Returns twice the work of that, less that of what they were to bear: over V_0 and times E.
  HWY_INLINE Lane<D> take_shear(const UnitForces<kElements, D>& forces, LaneMask<D> unsettled) {
    Lane<D> gained = 0;
    for (int e = 0; e < kElements; ++e) {
      const Lane<D> change = forces.outer[e] - forces.shared - masked(unsettled, sheared[e]);
      sheared[e] += change;
      gained = fnma(compression[e] * elastic_.shear, change * change, gained);
    }
    return gained;
  }

  /// Strains, and if the elements shear the turns that they bear by shear: the strains for which the forces are whole.
  [[nodiscard]] HWY_INLINE UnitStrains<kElements, D> with_shear(UnitStrains<kElements, D> strains) const {
    if (HWY_UNLIKELY(shears())) {
      for (int e = 0; e < kElements; ++e) {
        const Lane<D> turn = elastic_.shear * sheared[e];
        strains.outer[e] += turn;
        strains.shared = fnma(compression[e], turn, strains.shared);
      }
    }
    return strains;
  }

  [[nodiscard]] HWY_INLINE bool is_soft(int e, int i) const { return (soft[e] >> i & 1U) != 0; }

  /// Forces of section i of element e under the forces of the unit: constant axial force, linear moment.
  [[nodiscard]] HWY_INLINE SectionForce<D> under(const UnitForces<kElements, D>& forces, int e, int i) const {
    const auto& factors = rule_.moments[e];
    return {forces.axial[e],
            fma(Lane<D>(factors.outer[i]), forces.outer[e], Lane<D>(factors.shared[i]) * forces.shared)};
  }

  /// Changes of the forces with which elastic sections take up the strains.
  [[nodiscard]] HWY_INLINE UnitForces<kElements, D> elastic_change(const UnitStrains<kElements, D>& strains) const {
    Turns turns;
    for (int e = 0; e < kElements; ++e) {
      turns.outer[e] = strains.outer[e];
      turns.shared[e] = 0;
    }
    return solve_elastic(strains.axial, turns, strains.shared);
  }

  /// Forces with which the sections take up the strains, if all of them are elastic; these also correct what the
  /// sections are out of balance. The strains are those with_shear.
  [[nodiscard]] HWY_INLINE UnitForces<kElements, D> solve_elastic(const UnitStrains<kElements, D>& strains) const {
    Lane<D> axial[kElements];
    Turns turns;
    for (int e = 0; e < kElements; ++e) {
      const ElementEquations<D> of = elastic_equations(strains, e);
      axial[e] = of.of_n;
      turns.outer[e] = of.of_o;
      turns.shared[e] = of.of_s;
    }
    return solve_elastic(axial, turns, strains.shared);
  }

  /// The same with the flexibilities of the sections. The outer moment and then the axial force of each element are
  /// eliminated; one equation for the shared moment remains.
  [[nodiscard]] HWY_INLINE UnitForces<kElements, D> solve(const UnitStrains<kElements, D>& strains) const {
    const Lane<D> one = 1;
    ElementEquations<D> of[kElements];
    Lane<D> by_outer[kElements];
    Lane<D> by_axial[kElements];
    Lane<D> of_shared = strains.shared;
    Lane<D> of_unit = 0;
    for (int e = 0; e < kElements; ++e) {
      of[e] = equations(strains, e);
      by_outer[e] = one / of[e].oo;
      const Lane<D> no = of[e].no * by_outer[e];
      const Lane<D> os = of[e].os * by_outer[e];
      const Lane<D> nn = fnma(no, of[e].no, of[e].nn);
      const Lane<D> ns = fnma(no, of[e].os, of[e].ns);
      const Lane<D> of_n = fnma(no, of[e].of_o, of[e].of_n);
      by_axial[e] = one / nn;
      const Lane<D> share = ns * by_axial[e];
      of_unit = fma(compression[e], fnma(share, ns, fnma(os, of[e].os, of[e].ss)), of_unit);
      of_shared = fma(compression[e], fnma(share, of_n, fnma(os, of[e].of_o, of[e].of_s)), of_shared);
      of[e].ns = ns;
      of[e].of_n = of_n;
    }
    UnitForces<kElements, D> forces;
    forces.shared = of_shared / of_unit;
    for (int e = 0; e < kElements; ++e) {
      forces.axial[e] = fnma(of[e].ns, forces.shared, of[e].of_n) * by_axial[e];
      forces.outer[e] = fnma(of[e].no, forces.axial[e], fnma(of[e].os, forces.shared, of[e].of_o)) * by_outer[e];
    }
    return forces;
  }

 private:
  /// Right-hand sides for the moments of the elements.
  struct Turns {
    Lane<D> outer[kElements];
    Lane<D> shared[kElements];
  };

  [[nodiscard]] HWY_INLINE UnitForces<kElements, D> solve_elastic(const Lane<D> (&axial)[kElements], const Turns& turns,
                                                                  Lane<D> shared_turn) const {
    UnitForces<kElements, D> forces;
    Lane<D> compressions = 0;
    for (int e = 0; e < kElements; ++e) {
      shared_turn = fma(compression[e], fnma(elastic_.carried, turns.outer[e], turns.shared[e]), shared_turn);
      compressions += compression[e];
    }
    forces.shared = elastic_.far_held / compressions * shared_turn;
    for (int e = 0; e < kElements; ++e) {
      forces.axial[e] = axial[e];
      forces.outer[e] = fnma(elastic_.carried, forces.shared, elastic_.far_free * turns.outer[e]);
    }
    return forces;
  }

  [[nodiscard]] HWY_INLINE ElementEquations<D> elastic_equations(const UnitStrains<kElements, D>& strains,
                                                                 int e) const {
    const auto& factors = rule_.moments[e];
    ElementEquations<D> of = {1, 0, 0, elastic_.near, elastic_.far, elastic_.near, strains.axial[e], strains.outer[e],
                              0};
    for (int i = 0; i < rule_.sections(); ++i) {
      of.of_n = fma(Lane<D>(rule_.along_weight[i]), force[e][i].axial, of.of_n);
      of.of_o = fma(Lane<D>(factors.weighted_outer[i]), force[e][i].moment, of.of_o);
      of.of_s = fma(Lane<D>(factors.weighted_shared[i]), force[e][i].moment, of.of_s);
    }
    return of;
  }

  /// The elastic equations, and what the soft sections add to them.
  [[nodiscard]] HWY_INLINE ElementEquations<D> equations(const UnitStrains<kElements, D>& strains, int e) const {
    const auto& factors = rule_.moments[e];
    const Lane<D> one = 1;
    ElementEquations<D> of = elastic_equations(strains, e);
    for (int i = 0; i < rule_.sections(); ++i) {
      if (!is_soft(e, i)) {
        continue;
      }
      const SectionFlexibility<D>& all = flexibility[e][i];
      const SectionFlexibility<D> more = {all.axial - one, all.mixed, all.bending - one};
      const SectionForce<D> strain = more.strains_of(force[e][i]);
      of.nn = fma(Lane<D>(rule_.along_weight[i]), more.axial, of.nn);
      of.no = fma(Lane<D>(factors.weighted_outer[i]), more.mixed, of.no);
      of.ns = fma(Lane<D>(factors.weighted_shared[i]), more.mixed, of.ns);
      of.oo = fma(Lane<D>(factors.outer_outer[i]), more.bending, of.oo);
      of.os = fma(Lane<D>(factors.outer_shared[i]), more.bending, of.os);
      of.ss = fma(Lane<D>(factors.shared_shared[i]), more.bending, of.ss);
      of.of_n = fma(Lane<D>(rule_.along_weight[i]), strain.axial, of.of_n);
      of.of_o = fma(Lane<D>(factors.weighted_outer[i]), strain.moment, of.of_o);
      of.of_s = fma(Lane<D>(factors.weighted_shared[i]), strain.moment, of.of_s);
    }
    return of;
  }

  const Rule& rule_;
  const ElasticElement<D>& elastic_;
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_BEAM_FORCE_BALANCE_INL_H_

// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_BEAM_ELEMENT_RESPONSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_BEAM_ELEMENT_RESPONSE_INL_H_
#undef CELLCRUSH_BEAM_ELEMENT_RESPONSE_INL_H_
#else
#define CELLCRUSH_BEAM_ELEMENT_RESPONSE_INL_H_
#endif

#include <cstddef>
#include <numbers>

#include "beam/force_balance-inl.h"
#include "beam/internal_forces.h"
#include "section/return_mapping-inl.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Strain increments of an element over a step (E5).
template <class D>
struct ElementStrains {
  Lane<D> membrane;    ///< Delta / L
  Lane<D> bend_start;  ///< h theta_1 / L
  Lane<D> bend_end;    ///< h theta_2 / L
};

/// Sums over the fibres of an element (Eq. 28, E7), before they are multiplied by area and thickness. MPa.
template <class D>
struct ElementSums {
  Lane<D> axial;
  Lane<D> moment_start;  ///< m_1 over A h
  Lane<D> moment_end;    ///< m_2 over A h
  Lane<D> plastic_work;

  HWY_INLINE ElementSums() : axial(0), moment_start(0), moment_end(0), plastic_work(0) {}
};

/// Displacement-based element: the curvature varies linearly (Eq. 27, E5a).
template <class Law, class Rule, class D>
HWY_INLINE ElementSums<D> return_map_element(const LaneMaterial<D>& material, const Rule& rule,
                                             const ElementStrains<D>& strains, const Fibres<hn::TFromD<D>>& fibres,
                                             double step) {
  const FibreLaw<Law, D> law(material, step);
  FibreBits<D> yields;
  const Lane<D> stretched = material.modulus * strains.membrane;
  ElementSums<D> element;
  for (int i = 0; i < rule.sections(); ++i) {
    const auto first = static_cast<std::size_t>(i * rule.depth_points());
    const Lane<D> curvature =
        fma(Lane<D>(rule.bend_start[i]), strains.bend_start, Lane<D>(rule.bend_end[i]) * strains.bend_end);
    const SectionSums<D> section = return_map_section(law, rule, rule.offset, rule.offset_weight, stretched,
                                                      material.modulus * curvature, fibres, first, yields);
    const Lane<D> weight = rule.along_weight[i];
    element.axial = fma(weight, section.axial, element.axial);
    element.moment_start = fma(Lane<D>(rule.moment_start[i]), section.moment, element.moment_start);
    element.moment_end = fma(Lane<D>(rule.moment_end[i]), section.moment, element.moment_end);
    element.plastic_work = fma(weight, section.plastic_work, element.plastic_work);
  }
  keep_yields<Law>(yields, fibres);
  return element;
}

/// Where the state keeps what a force-based element remembers.
template <class T>
struct ElementMemory {
  Fibres<T> fibres;
  T* axial;   ///< n of the sections, `fibres.stride` apart
  T* moment;  ///< m of the sections, `fibres.stride` apart
  /// Fibres that yielded in the last step, with a mark if any had in the step before.
  typename FibreHistory<T>::Bits* yielding;
  T* end_force;  ///< kEndForces of them, `fibres.stride` apart
  T* owed;
};

/// A step of a force-based unit (E5b, E5d): Neuenhofer and Filippou's state determination without iteration (1997),
/// with an elastic look-ahead. The forces of the unit follow from the strains and the flexibilities of the sections;
/// they give the strains of the sections; every fibre is mapped back once; and the forces are corrected, to first
/// order, for what the sections are then out of balance. The strains of the next step are found from the forces that
/// the sections bear. While no fibre has yielded in the last two steps, the sections are in balance, and only changes
/// are computed: otherwise the rounding of sums would add up over the steps. While one has, the forces are corrected
/// once more, so that their work is that of the sections (E5h).
template <class Law, int kElements, class Rule, class D>
class UnitResponse {
  using T = hn::TFromD<D>;

 public:
  /// Keeps references.
  HWY_INLINE UnitResponse(const Rule& rule, double step, const ElasticElement<D>& elastic)
      : rule_(rule), step_(step), sections_(rule, elastic) {}

  /// `material` must outlive the unit. `compressed`: whether the materials of any lanes are softened; `modulus` is E of
  /// the wall.
  HWY_INLINE void set(int e, const LaneMaterial<D>& material, Lane<D> modulus, bool compressed,
                      const ElementMemory<T>& memory, const ElementStrains<D>& strains) {
    material_[e] = &material;
    memory_[e] = memory;
    yielding_[e] = FibreBits<D>::load(memory.yielding);
    sections_.compression[e] = compressed ? modulus / material.modulus : Lane<D>(1);
    for (int i = 0; i < rule_.sections(); ++i) {
      sections_.force[e][i] = {Lane<D>::load(memory.axial + i * memory.fibres.stride),
                               Lane<D>::load(memory.moment + i * memory.fibres.stride)};
    }
    const Lane<D> gyration = T(kGyrationOfThickness);
    const Lane<D> of_turn = gyration * material.modulus;
    strains_.axial[e] = material.modulus * strains.membrane;
    strains_.outer[e] = e == 0 ? of_turn * strains.bend_start : -(of_turn * strains.bend_end);
    if (e + 1 == kElements) {
      // Of two elements, the turn between them, which is that of the start of the second.
      strains_.shared = gyration * modulus * (kElements == 1 ? -strains.bend_end : strains.bend_start);
    }
  }

  /// Of an element that shears: what its shear bears. Updated by advance().
  HWY_INLINE void set_shear(int e, T* shear) {
    shear_[e] = shear;
    sections_.sheared[e] = Lane<D>::load(shear);
  }

  /// Updates the memories of the elements and returns their sums.
  HWY_INLINE void advance(ElementSums<D> (&sums)[kElements]) {
    const LaneMask<D> unsettled = bits().lanes();
    const LaneMask<D> soft = bits().without_mark().lanes();
    UnitForces<kElements, D> forces = sections_.elastic_change(strains_);
    if (any(unsettled)) {
      const UnitStrains<kElements, D> strains = sections_.with_shear(strains_);
      UnitForces<kElements, D> whole = sections_.solve_elastic(strains);
      if (any(soft)) {
        soften_ahead(whole);
        whole = select(soft, sections_.solve(strains), whole);
      }
      forces = select(unsettled, whole, forces);
    }
    const Lane<D> gained = map_back(forces, unsettled, sums);
    UnitForces<kElements, D> ends = corrected();
    const LaneMask<D> disturbed = soft | bits().lanes();
    if (any(disturbed)) {
      make_work_exact(disturbed, unsettled, forces, gained, ends);
    }
    keep_end_forces(ends);
    put(ends, soft, sums);
  }

 private:
  /// gamma / h.
  static constexpr double kGyrationOfThickness = 0.5 / std::numbers::sqrt3;
  /// Bounds of E5h: the greatest correction over the elastic change of the step, and the least work of that change,
  /// over the square of the yield stress.
  static constexpr double kMostCorrection = 0.3;
  static constexpr double kLeastWork = 1e-9;

  [[nodiscard]] HWY_INLINE FibreLaw<Law, D> law_of(int e) const { return {*material_[e], step_}; }

  /// Those of all elements.
  [[nodiscard]] HWY_INLINE FibreBits<D> bits() const {
    return kElements > 1 ? yielding_[0] | yielding_[1] : yielding_[0];
  }

  [[nodiscard]] HWY_INLINE std::size_t first_fibre(int i) const {
    return static_cast<std::size_t>(i) * rule_.depth_points();
  }

  /// Calls visit(e, i, bits) for every section in which a fibre of any lane yields, and marks it as soft; the others
  /// become elastic.
  template <class Visit>
  HWY_INLINE void visit_yielding(const Visit& visit) {
    for (int e = 0; e < kElements; ++e) {
      sections_.soft[e] = 0;
      for (int i = 0; i < rule_.sections(); ++i) {
        const FibreBits<D> of_section = yielding_[e].section(first_fibre(i), rule_.depth_points());
        if (any(of_section.lanes())) {
          sections_.soft[e] |= 1U << i;
          visit(e, i, of_section);
        }
      }
    }
  }

  /// Flexibilities for the forces that elastic sections would have.
  HWY_INLINE void soften_ahead(const UnitForces<kElements, D>& elastic) {
    visit_yielding([&](int e, int i, const FibreBits<D>& yielding) HWY_ATTR {
      const SectionForce<D> strains = sections_.under(elastic, e, i) - sections_.force[e][i];
      sections_.flexibility[e][i] = look_ahead(rule_, law_of(e), memory_[e].fibres, yielding, first_fibre(i), strains);
    });
  }

  /// By how much section i of element e is to bear more. The forces of unsettled lanes are whole, those of the others
  /// are changes.
  [[nodiscard]] HWY_INLINE SectionForce<D> change_of(const UnitForces<kElements, D>& forces, LaneMask<D> unsettled,
                                                     int e, int i) const {
    const SectionForce<D> borne = sections_.force[e][i];
    return sections_.under(forces, e, i) -
           SectionForce<D>{masked(unsettled, borne.axial), masked(unsettled, borne.moment)};
  }

  /// Returns twice the work of the sections, less that of what they were to bear: over V_0 and times E.
  HWY_INLINE Lane<D> map_back(const UnitForces<kElements, D>& forces, LaneMask<D> unsettled,
                              ElementSums<D> (&sums)[kElements]) {
    Lane<D> gained = 0;
    for (int e = 0; e < kElements; ++e) {
      const FibreLaw<Law, D> law = law_of(e);
      FibreBits<D> yields;  // not the member: a store of a stress may alias it
      Lane<D> of_element = 0;
      sums[e].plastic_work = 0;
      for (int i = 0; i < rule_.sections(); ++i) {
        const SectionForce<D> change = change_of(forces, unsettled, e, i);
        const SectionForce<D> strains =
            sections_.is_soft(e, i) ? sections_.flexibility[e][i].strains_of(change) : change;
        const SectionSums<D> now = return_map_section(law, rule_, rule_.arm, rule_.arm_weight, strains.axial,
                                                      strains.moment, memory_[e].fibres, first_fibre(i), yields);
        const SectionForce<D> more = SectionForce<D>{now.axial, now.moment} - sections_.force[e][i] - change - change;
        sections_.force[e][i] = {now.axial, now.moment};
        const Lane<D> weight = rule_.along_weight[i];
        of_element = fma(weight, fma(more.axial, strains.axial, more.moment * strains.moment), of_element);
        sums[e].plastic_work = fma(weight, now.plastic_work, sums[e].plastic_work);
      }
      yielding_[e] = yields;
      keep_yields<Law>(yields, memory_[e].fibres);
      gained = fma(sections_.compression[e], of_element, gained);
    }
    if (HWY_UNLIKELY(sections_.shears())) {
      gained += sections_.take_shear(forces, unsettled);
    }
    return gained;
  }

  /// Forces that the sections can bear together, with no strain.
  [[nodiscard]] HWY_INLINE UnitForces<kElements, D> corrected() {
    const UnitStrains<kElements, D> none = sections_.with_shear(UnitStrains<kElements, D>::none());
    const UnitForces<kElements, D> forces = sections_.solve_elastic(none);
    const LaneMask<D> yields = bits().lanes();
    if (!any(yields)) {
      return forces;
    }
    visit_yielding([&](int e, int i, const FibreBits<D>& yielding) HWY_ATTR {
      sections_.flexibility[e][i] = flexibility_of(rule_, law_of(e), memory_[e].fibres, first_fibre(i),
                                                   [&](int j) HWY_ATTR { return yielding.has(j); });
    });
    return select(yields, sections_.solve(none), forces);
  }

  /// Corrects the end forces of the lanes along those of an elastic step, by half of what their work and that of the
  /// sections are apart: a force works in two steps. The rest is owed to the next step (E5h). Both works are taken less
  /// that of the forces that the sections were to bear, `wanted` (of settled lanes changes): the difference of the
  /// whole works would be that of rounding in slow motions. `gained`: of map_back.
  HWY_INLINE void make_work_exact(LaneMask<D> lanes, LaneMask<D> unsettled, const UnitForces<kElements, D>& wanted,
                                  Lane<D> gained, UnitForces<kElements, D>& ends) {
    const Lane<D> owed = Lane<D>::load(memory_[0].owed);
    const UnitForces<kElements, D> elastic = sections_.elastic_change(strains_);
    const UnitForces<kElements, D> before = end_forces_before();
    const auto less = [&](Lane<D> want, Lane<D> old, Lane<D> now) HWY_ATTR {
      const Lane<D> whole = select(unsettled, want, old + want);
      return (whole - old) + (whole - now);
    };
    Lane<D> missing = gained + owed;
    Lane<D> whole = elastic.shared * strains_.shared;
    missing = fma(less(wanted.shared, before.shared, ends.shared), strains_.shared, missing);
    for (int e = 0; e < kElements; ++e) {
      const Lane<D> axial = sections_.compression[e] * strains_.axial[e];
      const Lane<D> outer = sections_.compression[e] * strains_.outer[e];
      missing = fma(less(wanted.axial[e], before.axial[e], ends.axial[e]), axial, missing);
      missing = fma(less(wanted.outer[e], before.outer[e], ends.outer[e]), outer, missing);
      whole = fma(elastic.axial[e], axial, fma(elastic.outer[e], outer, whole));
    }
    const Lane<D> yield = material_[0]->yield_stress;
    const Lane<D> least = Lane<D>(T(kLeastWork)) * yield * yield;
    const Lane<D> most = T(kMostCorrection);
    const Lane<D> share = masked(lanes, max(min(T(0.5) * missing / max(whole, least), most), -most));
    select(lanes, fnma(share, whole, missing), owed).store(memory_[0].owed);
    for (int e = 0; e < kElements; ++e) {
      ends.axial[e] = fma(share, elastic.axial[e], ends.axial[e]);
      ends.outer[e] = fma(share, elastic.outer[e], ends.outer[e]);
    }
    ends.shared = fma(share, elastic.shared, ends.shared);
  }

  [[nodiscard]] HWY_INLINE UnitForces<kElements, D> end_forces_before() const {
    UnitForces<kElements, D> forces;
    for (int e = 0; e < kElements; ++e) {
      forces.axial[e] = Lane<D>::load(memory_[e].end_force);
      forces.outer[e] = Lane<D>::load(memory_[e].end_force + memory_[e].fibres.stride);
    }
    forces.shared = Lane<D>::load(memory_[0].end_force + 2 * memory_[0].fibres.stride);
    return forces;
  }
  HWY_INLINE void keep_end_forces(const UnitForces<kElements, D>& forces) const {
    for (int e = 0; e < kElements; ++e) {
      forces.axial[e].store(memory_[e].end_force);
      forces.outer[e].store(memory_[e].end_force + memory_[e].fibres.stride);
    }
    forces.shared.store(memory_[0].end_force + 2 * memory_[0].fibres.stride);
  }

  /// `soft`: lanes in which fibres had yielded before the step; they may be out of balance, and are marked.
  HWY_INLINE void put(const UnitForces<kElements, D>& forces, LaneMask<D> soft, ElementSums<D> (&sums)[kElements]) {
    const Lane<D> gyration = T(kGyrationOfThickness);
    const Lane<D> shared = gyration * forces.shared;
    for (int e = 0; e < kElements; ++e) {
      const Lane<D> outer = gyration * forces.outer[e];
      sums[e].axial = forces.axial[e];
      sums[e].moment_start = e == 0 ? outer : shared;
      sums[e].moment_end = e == 0 ? -shared : -outer;
      for (int i = 0; i < rule_.sections(); ++i) {
        sections_.force[e][i].axial.store(memory_[e].axial + i * memory_[e].fibres.stride);
        sections_.force[e][i].moment.store(memory_[e].moment + i * memory_[e].fibres.stride);
      }
      if (HWY_UNLIKELY(sections_.shears())) {
        sections_.sheared[e].store(shear_[e]);
      }
      yielding_[e].mark(soft);
      yielding_[e].store(memory_[e].yielding);
    }
  }

  const Rule& rule_;
  const double step_;
  UnitSections<kElements, Rule, D> sections_;
  UnitStrains<kElements, D> strains_;
  const LaneMaterial<D>* material_[kElements];
  ElementMemory<T> memory_[kElements];
  FibreBits<D> yielding_[kElements];
  T* shear_[kElements];  // only if the elements shear
};

/// Strain increments of the elements of a row (E5), passed from the first loop over a chunk to the second.
template <class T>
struct RowStrains {
  T* membrane;
  T* bend_start;  ///< h theta_1 / L; of coupled bending, the change of h Theta_1 / l (E5j)
  T* bend_end;
  T* modulus_share;
};

/// Sums over the stresses of the elements of a row (E7), passed from the second loop to the third.
template <class T>
struct RowSums {
  T* axial;
  T* moment_start;
  T* moment_end;
  T* plastic_work;
};

/// Values passed between the three loops over the elements of a chunk, in the precision of the fibres, kScratchKinds
/// per element. Row by row: values of one kind lie side by side, and the kinds of a row one after the other. The sums
/// overwrite the strains.
template <class T>
class ChunkScratch {
 public:
  HWY_INLINE ChunkScratch(T* values, std::ptrdiff_t first_element) : values_(values), first_(first_element) {}

  HWY_INLINE RowStrains<T> strains(std::ptrdiff_t row, int lane, int walls) const {
    T* const at = begin(row, lane);
    return {at, at + walls, at + 2 * walls, at + 3 * walls};
  }
  HWY_INLINE RowSums<T> sums(std::ptrdiff_t row, int lane, int walls) const {
    T* const at = begin(row, lane);
    return {at, at + walls, at + 2 * walls, at + 3 * walls};
  }

 private:
  HWY_INLINE T* begin(std::ptrdiff_t row, int lane) const {
    return values_ + static_cast<std::ptrdiff_t>(kScratchKinds) * (row - first_) + lane;
  }

  T* const values_;
  const std::ptrdiff_t first_;
};

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_BEAM_ELEMENT_RESPONSE_INL_H_

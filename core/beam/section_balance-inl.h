// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_BEAM_SECTION_BALANCE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_BEAM_SECTION_BALANCE_INL_H_
#undef CELLCRUSH_BEAM_SECTION_BALANCE_INL_H_
#else
#define CELLCRUSH_BEAM_SECTION_BALANCE_INL_H_
#endif

#include <cstddef>
#include <type_traits>

#include "section/lane_material-inl.h"
#include "section/rule_factors.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Greatest flexibility of a section over its elastic one, the inverse of the least t_i of E5b; it keeps the
/// flexibility of the element finite.
inline constexpr double kMostFlexibility = 100.0;
/// Flexibility, over the elastic one, below which a section counts as elastic.
template <class T>
inline constexpr T kElasticBelow = std::is_same_v<T, double> ? T(1.0 + 1e-6) : T(1.01);
/// Moment over b h^2, as a fraction of the yield stress, below which it counts as 0.
template <class T>
inline constexpr T kSectionRoundOff = std::is_same_v<T, double> ? T(6e-10) : T(2e-6);
/// Greatest residual moment that is carried into the next step, as a fraction of the full plastic moment.
inline constexpr double kInBalance = 0.02;

/// History of the sections of force-based elements, in the arrays of the state (E5b).
template <class T>
struct SectionHistoryView {
  /// u_i over b h^2, MPa: moment by which the section falls short of the line through the end moments.
  T* residual;
  T* flexibility;          ///< 1 / t_i, flexibility over the elastic one in the newest step, 1 ... kMostFlexibility
  std::size_t stride = 1;  ///< from one section to the next
};

/// End moments m_1 and m_2 over b h^2, MPa: conjugate to the rotations of the nodes (Eq. 28, E7).
template <class D>
struct EndMoments {
  Lane<D> start;
  Lane<D> end;

  /// M(s), the moment at s on the line between them (E5b).
  [[nodiscard]] HWY_INLINE Lane<D> at(Lane<D> s) const { return fnma(s, start + end, start); }
};

/// h theta_1 / l_m and h theta_2 / l_m: rotations of the ends of elements over a step, times h / l_m.
template <class D>
struct Bend {
  Lane<D> start;
  Lane<D> end;
};

/// Sums over the sections of an element (Eq. 28, E7), before they are multiplied by area and thickness. MPa.
template <int kRoom, class D>
struct ElementSums {
  Lane<D> axial;
  EndMoments<D> moments;
  Lane<D> plastic_work;
  Lane<D> moment[kRoom];  ///< of each section

  HWY_INLINE ElementSums() : axial(0), moments{0, 0}, plastic_work(0) {}
};

/// History of the sections of the lanes, in registers.
template <int kRoom, class D>
struct SectionHistory {
  Lane<D> residual[kRoom];
  Lane<D> flexibility[kRoom];

  HWY_INLINE SectionHistory(const SectionHistoryView<hn::TFromD<D>>& memory, int sections) {
    for (int i = 0; i < sections; ++i) {
      residual[i] = Lane<D>::load(memory.residual + static_cast<std::size_t>(i) * memory.stride);
      flexibility[i] = Lane<D>::load(memory.flexibility + static_cast<std::size_t>(i) * memory.stride);
    }
  }
  HWY_INLINE void store(const SectionHistoryView<hn::TFromD<D>>& memory, int sections) const {
    for (int i = 0; i < sections; ++i) {
      residual[i].store(memory.residual + static_cast<std::size_t>(i) * memory.stride);
      flexibility[i].store(memory.flexibility + static_cast<std::size_t>(i) * memory.stride);
    }
  }

  /// Lanes whose sections are all elastic and balanced: their curvature is linear.
  [[nodiscard]] HWY_INLINE LaneMask<D> is_straight(int sections) const {
    auto off = hn::Zero(D());
    for (int i = 0; i < sections; ++i) {
      off = hn::Or(off, hn::Or(hn::Xor(flexibility[i].raw, hn::Set(D(), 1)), residual[i].raw));
    }
    return Lane<D>(off) == 0;
  }
};

/// Increments of curvature times h that vary linearly along the element (Eq. 27, E5a).
template <class Rule, class D>
HWY_INLINE void straight_curvatures(const Rule& rule, const Bend<D>& bend, Lane<D>* HWY_RESTRICT curvature) {
  for (int i = 0; i < rule.sections(); ++i) {
    curvature[i] = fma(Lane<D>(rule.bend_start[i]), bend.start, Lane<D>(rule.bend_end[i]) * bend.end);
  }
}

/// Flexibility 1 / t_i of sections. Their moment over b h^2 rose by `gained`; elastic ones would have gained `elastic`,
/// not 0.
template <class D>
HWY_INLINE Lane<D> shown_flexibility(Lane<D> elastic, Lane<D> gained) {
  using T = hn::TFromD<D>;
  const Lane<D> most = T(kMostFlexibility);
  const Lane<D> flexibility = elastic / gained;
  const LaneMask<D> is_between = (flexibility > 0) & (flexibility < most);
  return select(is_between, select(flexibility < kElasticBelow<T>, 1, flexibility), most);
}

/// Increments of curvature times h of a force-based element (E5b; Spacone, Filippou and Taucer, 1996). With them the
/// moment varies linearly along the element, as equilibrium requires. They integrate to the end rotations times h /
/// l_m. Moments are expressed as the elastic curvatures that they cause.
///
/// The flexibility of a section is that of its last step. Its error appears as the residual, which another pass or the
/// next step removes. A section that has yielded but now unloads counts as elastic. One that was compressed and carries
/// no moment cannot unload. Only the history of the lanes `active` is changed.
template <class Rule, int kRoom, class D>
HWY_INLINE void balanced_curvatures(const Rule& rule, const LaneMaterial<D>& material, const EndMoments<D>& moments,
                                    LaneMask<D> active, const Bend<D>& bend, SectionHistory<kRoom, D>& history,
                                    Lane<D>* HWY_RESTRICT curvature) {
  using T = hn::TFromD<D>;
  const Lane<D> round_off = Lane<D>(kSectionRoundOff<T>) * material.yield_stress;
  for (bool unloads = true; unloads;) {
    // Flexibility of the element, a symmetric 2 x 2 matrix, and the rotations that remain for it.
    Lane<D> start = 0;
    Lane<D> mixed = 0;
    Lane<D> end = 0;
    Bend<D> left = bend;
    for (int i = 0; i < rule.sections(); ++i) {
      start = fma(Lane<D>(rule.turn_start_start[i]), history.flexibility[i], start);
      mixed = fma(Lane<D>(rule.turn_start_end[i]), history.flexibility[i], mixed);
      end = fma(Lane<D>(rule.turn_end_end[i]), history.flexibility[i], end);
      curvature[i] = material.bending_flexibility * history.residual[i] * history.flexibility[i];
      left.start = fnma(Lane<D>(rule.turn_start[i]), curvature[i], left.start);
      left.end = fma(Lane<D>(rule.turn_end[i]), curvature[i], left.end);
    }
    const Lane<D> inverse = Lane<D>(1) / fms(start, end, mixed * mixed);
    const EndMoments<D> increment = {inverse * fma(end, left.start, mixed * left.end),
                                     inverse * fma(start, left.end, mixed * left.start)};
    unloads = false;
    for (int i = 0; i < rule.sections(); ++i) {
      curvature[i] = fma(history.flexibility[i], increment.at(rule.along[i]), curvature[i]);
      const Lane<D> moment = moments.at(rule.along[i]) - history.residual[i];
      const LaneMask<D> turns_back =
          active & (abs(moment) > round_off) & (history.flexibility[i] > 1) & (curvature[i] * moment < 0);
      history.flexibility[i] = select(turns_back, 1, history.flexibility[i]);
      unloads = unloads || any(turns_back);
    }
  }
}

/// Updates the history after the moments of the sections have changed from `before` to those of `now` under increments
/// of curvature times h. Returns the lanes whose sections are all in balance to 2 % of the full plastic moment.
template <class Rule, int kRoom, class D>
HWY_INLINE LaneMask<D> update_section_history(const Rule& rule, const LaneMaterial<D>& material,
                                              const Lane<D>* HWY_RESTRICT before, const ElementSums<kRoom, D>& now,
                                              const Lane<D>* HWY_RESTRICT curvature, LaneMask<D> active,
                                              SectionHistory<kRoom, D>& history) {
  using T = hn::TFromD<D>;
  const Lane<D> round_off = Lane<D>(kSectionRoundOff<T>) * material.yield_stress;
  Lane<D> worst = 0;
  for (int i = 0; i < rule.sections(); ++i) {
    const Lane<D> elastic = material.modulus * Lane<D>(T(1.0 / 12.0)) * curvature[i];
    const Lane<D> shown = shown_flexibility(elastic, now.moment[i] - before[i]);
    history.flexibility[i] = select(active & (abs(elastic) > round_off), shown, history.flexibility[i]);
    const Lane<D> residual = now.moments.at(rule.along[i]) - now.moment[i];
    const Lane<D> size = abs(residual);
    history.residual[i] = select(active, masked(size > round_off, residual), history.residual[i]);
    worst = max(worst, size);
  }
  return worst <= Lane<D>(T(0.25 * kInBalance)) * material.yield_stress;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_BEAM_SECTION_BALANCE_INL_H_

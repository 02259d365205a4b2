// Included once for each target; see Highway's documentation of foreach_target.h.
#if defined(CELLCRUSH_BEAM_ELEMENT_RESPONSE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_BEAM_ELEMENT_RESPONSE_INL_H_
#undef CELLCRUSH_BEAM_ELEMENT_RESPONSE_INL_H_
#else
#define CELLCRUSH_BEAM_ELEMENT_RESPONSE_INL_H_
#endif

#include <cstddef>

#include "beam/section_balance-inl.h"
#include "section/return_mapping-inl.h"
#include "simd/lane-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

/// Return mapping of the fibres of all sections under given increments of membrane strain and of curvature times h (E5,
/// E6), and the sums over them (E7).
template <bool kHardening, class Rule, class D>
HWY_INLINE auto return_map_element(const LaneMaterial<D>& material, const Rule& rule, Lane<D> membrane,
                                   const Lane<D>* HWY_RESTRICT curvature, const Fibres<hn::TFromD<D>>& before,
                                   const Fibres<hn::TFromD<D>>& after) {
  FibreWriter<kHardening, D> next(material, before, after);
  ElementSums<Rule::kSectionRoom, D> element;
  for (int i = 0; i < rule.sections(); ++i) {
    const auto first = static_cast<std::size_t>(i * rule.depth_points());
    const SectionSums<D> section =
        return_map_section<kHardening>(material, rule, membrane, curvature[i], before, first, next);
    const Lane<D> weight = rule.along_weight[i];
    element.axial = fma(weight, section.axial, element.axial);
    element.moments.start = fma(Lane<D>(rule.moment_start[i]), section.moment, element.moments.start);
    element.moments.end = fma(Lane<D>(rule.moment_end[i]), section.moment, element.moments.end);
    element.plastic_work = fma(weight, section.plastic_work, element.plastic_work);
    element.moment[i] = section.moment;
  }
  next.finish();
  return element;
}

/// Most passes of a force-based element (E5b); one is enough in 97 of 100 element-steps.
inline constexpr int kMostPasses = 4;

/// The same for force-based elements: curvature is redistributed between the sections until their moments lie on a
/// straight line (E5b).
template <bool kHardening, class Rule, class D>
HWY_INLINE auto return_map_balanced(const LaneMaterial<D>& material, const Rule& rule, Lane<D> membrane,
                                    const Bend<D>& bend, const EndMoments<D>& before,
                                    const Fibres<hn::TFromD<D>>& fibres,
                                    const SectionHistoryView<hn::TFromD<D>>& memory) {
  constexpr int kRoom = Rule::kSectionRoom;
  FibreCopy<kRoom * Rule::kDepthRoom, kHardening, D> copy(fibres, rule.fibres());
  const Fibres<hn::TFromD<D>> fibres_before = copy.fibres();
  SectionHistory<kRoom, D> history(memory, rule.sections());
  const LaneMask<D> straight = history.is_straight(rule.sections());
  Lane<D> curvature[kRoom];
  straight_curvatures(rule, bend, curvature);
  if (!all(straight)) {
    Lane<D> balanced[kRoom];
    balanced_curvatures(rule, material, before, !straight, bend, history, balanced);
    for (int i = 0; i < rule.sections(); ++i) {
      curvature[i] = select(straight, curvature[i], balanced[i]);
    }
  }
  auto element = return_map_element<kHardening>(material, rule, membrane, curvature, fibres_before, fibres);
  LaneMask<D> active = !(straight & (element.plastic_work == 0));
  if (none(active)) {
    return element;  // elastic: in balance already, with no history to update
  }
  Lane<D> moment_before[kRoom];
  for (int i = 0; i < rule.sections(); ++i) {
    moment_before[i] = before.at(rule.along[i]) - history.residual[i];
  }
  for (int pass = 1;; ++pass) {
    active = active & !update_section_history(rule, material, moment_before, element, curvature, active, history);
    if (pass == kMostPasses || none(active)) {
      break;
    }
    Lane<D> moved[kRoom];
    balanced_curvatures(rule, material, element.moments, active, Bend<D>{0, 0}, history, moved);
    for (int i = 0; i < rule.sections(); ++i) {
      curvature[i] += masked(active, moved[i]);
    }
    element = return_map_element<kHardening>(material, rule, membrane, curvature, fibres_before, fibres);
  }
  history.store(memory, rule.sections());
  return element;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_BEAM_ELEMENT_RESPONSE_INL_H_

// Included once for each target. The text of beam/beam_element.h and beam/deformation.h, a lane an element.
#if defined(CELLCRUSH_BEAM_WALL_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef CELLCRUSH_BEAM_WALL_LANES_INL_H_
#undef CELLCRUSH_BEAM_WALL_LANES_INL_H_
#else
#define CELLCRUSH_BEAM_WALL_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include "beam/beam_element.h"
#include "beam/beam_section.h"
#include "beam/deformation.h"
#include "beam/section_curvatures-inl.h"
#include "cellcrush/scene.h"
#include "section/fibres-inl.h"
#include "simd/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

/// See Deformation.
template <class D>
struct LaneDeformation {
  hn::Vec<D> stretch;
  hn::Vec<D> rotation_start;
  hn::Vec<D> rotation_end;
  hn::Vec<D> length;
  hn::Vec<D> inverse_length;
  hn::Vec<D> inverse_mean;  ///< of the mean length of the step
  Points<D> axis;
};

/// See turn_between.
template <class D>
HWY_INLINE hn::Vec<D> turn_between(D d, const Points<D>& from, const Points<D>& to) {
  const auto sine = cross(from, to);
  const auto cosine = dot(from, to);
  const auto square = hn::Mul(sine, sine);
  auto series = hn::MulAdd(square, hn::Set(d, 105.0 / 3456.0), hn::Set(d, 15.0 / 336.0));
  series = hn::MulAdd(square, series, hn::Set(d, 3.0 / 40.0));
  series = hn::MulAdd(square, series, hn::Set(d, 1.0 / 6.0));
  const auto turn = hn::MulAdd(hn::Mul(sine, square), series, sine);
  const auto is_small = hn::And(hn::Lt(hn::Abs(sine), hn::Set(d, kSmallTurn)), hn::Gt(cosine, hn::Zero(d)));
  if (HWY_LIKELY(hn::AllTrue(d, is_small))) {
    return turn;
  }
  double values[3][kMostWallsInBlock];
  hn::StoreU(sine, d, values[0]);
  hn::StoreU(cosine, d, values[1]);
  for (std::size_t lane = 0; lane < hn::Lanes(d); ++lane) {
    values[2][lane] = std::atan2(values[0][lane], values[1][lane]);
  }
  return hn::IfThenElse(is_small, turn, hn::LoadU(d, values[2]));
}

/// 1 / sqrt(square) and 2 / (length + previous length), where the lengths differ by so little that series from the inverse
/// of the previous length give all digits: dividers are the slowest part of a processor. Else divided.
template <class D>
HWY_INLINE void invert_lengths(D d, hn::Vec<D> square, hn::Vec<D> previous_length, hn::Vec<D> previous_inverse,
                               LaneDeformation<D>& deformation) {
  constexpr double kSmallMiss = 2e-3;  // the first terms left out are below 1e-17
  const auto one = hn::Set(d, 1.0);
  const auto half = hn::Set(d, 0.5);
  const auto miss = hn::NegMulAdd(square, hn::Mul(previous_inverse, previous_inverse), one);
  const auto series = hn::MulAdd(miss, hn::MulAdd(miss, hn::Set(d, 0.375), half), one);
  const auto near = hn::Mul(previous_inverse, series);
  const auto left = hn::NegMulAdd(square, hn::Mul(near, near), one);
  deformation.inverse_length = hn::MulAdd(hn::Mul(near, half), left, near);
  deformation.length = hn::Mul(square, deformation.inverse_length);
  const auto mean = hn::Mul(half, hn::Add(deformation.length, previous_length));
  const auto guess = hn::Mul(half, hn::Add(deformation.inverse_length, previous_inverse));
  const auto rest = hn::NegMulAdd(mean, guess, one);
  deformation.inverse_mean = hn::MulAdd(hn::Mul(guess, rest), hn::Add(one, rest), guess);
  const auto is_small = hn::Lt(hn::Abs(miss), hn::Set(d, kSmallMiss));
  if (HWY_UNLIKELY(!hn::AllTrue(d, is_small))) {
    const auto length = hn::Sqrt(square);
    deformation.length = hn::IfThenElse(is_small, deformation.length, length);
    deformation.inverse_length = hn::IfThenElse(is_small, deformation.inverse_length, hn::Div(one, length));
    deformation.inverse_mean =
        hn::IfThenElse(is_small, deformation.inverse_mean, hn::Div(hn::Set(d, 2.0), hn::Add(length, previous_length)));
  }
}

/// See reverse_motion.
template <class D>
HWY_INLINE LaneDeformation<D> reverse_motion(D d, const Points<D>& start, const Points<D>& end,
                                             const Points<D>& previous_axis, hn::Vec<D> previous_length,
                                             hn::Vec<D> previous_inverse, hn::Vec<D> turn_start, hn::Vec<D> turn_end) {
  const Points<D> span = {hn::Sub(end.x, start.x), hn::Sub(end.y, start.y)};
  LaneDeformation<D> deformation;
  invert_lengths(d, dot(span, span), previous_length, previous_inverse, deformation);
  deformation.axis = {hn::Mul(span.x, deformation.inverse_length), hn::Mul(span.y, deformation.inverse_length)};
  const auto rigid_turn = turn_between(d, previous_axis, deformation.axis);
  deformation.stretch = hn::Sub(deformation.length, previous_length);
  deformation.rotation_start = hn::Sub(turn_start, rigid_turn);
  deformation.rotation_end = hn::Sub(turn_end, rigid_turn);
  return deformation;
}

/// Lanes that have been squashed short; see kShortenedTo.
template <class D>
HWY_INLINE hn::Mask<D> is_short(D d, hn::Vec<D> length, hn::Vec<D> undeformed) {
  return hn::Lt(length, hn::Mul(hn::Set(d, kShortenedTo), undeformed));
}

/// See bounded_stiffness.
template <class D>
HWY_INLINE hn::Vec<D> bounded_stiffness(D d, hn::Vec<D> length, hn::Vec<D> undeformed, hn::Vec<D> thickness,
                                        bool constant_area) {
  const auto bound = hn::Mul(hn::Set(d, kShortenedTo), undeformed);
  const auto one = hn::Set(d, 1.0);
  const auto gyration = hn::Mul(hn::Mul(thickness, thickness), hn::Set(d, 1.0 / 3.0));
  const auto ratio = hn::Div(length, bound);
  const auto at_bound = hn::Add(one, hn::Div(gyration, hn::Mul(bound, bound)));
  const auto now = hn::Add(one, hn::Div(gyration, hn::Mul(length, length)));
  const auto share = hn::Div(hn::Mul(constant_area ? ratio : hn::Mul(ratio, ratio), at_bound), now);
  return hn::IfThenElse(is_short(d, length, undeformed), share, one);
}

/// Area of the lanes' elements; see section_of.
template <class D>
HWY_INLINE hn::Vec<D> area_of(D d, const Scene& scene, hn::Vec<D> undeformed, hn::Vec<D> thickness,
                              hn::Vec<D> inverse_length) {
  const auto area = hn::Mul(hn::Set(d, scene.depth), thickness);
  return scene.constant_area ? area : hn::Mul(hn::Mul(area, undeformed), inverse_length);
}

/// Volume of the lanes' elements; see section_of.
template <class D>
HWY_INLINE hn::Vec<D> volume_of(D d, const Scene& scene, hn::Vec<D> undeformed, hn::Vec<D> thickness,
                                hn::Vec<D> length) {
  return hn::Mul(hn::Mul(hn::Set(d, scene.depth), thickness), scene.constant_area ? length : undeformed);
}

/// See return_element.
template <bool kHardening, int kSections, int kDepthPoints, class D>
HWY_INLINE LaneSums<kSections, D> return_element(D d, const LaneMaterial<D>& material,
                                                 const RuleFactors<kSections, kDepthPoints, hn::TFromD<D>>& rule,
                                                 hn::Vec<D> membrane, const hn::Vec<D>* HWY_RESTRICT curvature,
                                                 const Fibres<hn::TFromD<D>>& before,
                                                 const Fibres<hn::TFromD<D>>& after) {
  FibreWriter<kHardening, D> next(material, before, after);
  LaneSums<kSections, D> element;
  element.axial = hn::Zero(d);
  element.moments = {hn::Zero(d), hn::Zero(d)};
  element.plastic_work = hn::Zero(d);
  for (int i = 0; i < kSections; ++i) {
    const std::size_t first = static_cast<std::size_t>(i) * kDepthPoints;
    const auto section = return_section<kDepthPoints, kHardening>(d, material, rule.offset, rule.depth_weight, membrane,
                                                                  curvature[i], before, first, next);
    const auto weight = hn::Set(d, rule.along_weight[i]);
    element.axial = hn::MulAdd(weight, section.axial, element.axial);
    element.moments.start = hn::MulAdd(hn::Set(d, rule.moment_start[i]), section.moment, element.moments.start);
    element.moments.end = hn::MulAdd(hn::Set(d, rule.moment_end[i]), section.moment, element.moments.end);
    element.plastic_work = hn::MulAdd(weight, section.plastic_work, element.plastic_work);
    element.moment[i] = section.moment;
  }
  next.finish();
  return element;
}

/// See return_balanced.
template <bool kHardening, int kSections, int kDepthPoints, class D>
HWY_INLINE LaneSums<kSections, D> return_balanced(D d, const LaneMaterial<D>& material,
                                                  const RuleFactors<kSections, kDepthPoints, hn::TFromD<D>>& rule,
                                                  hn::Vec<D> membrane, hn::Vec<D> bend_start, hn::Vec<D> bend_end,
                                                  const LaneMoments<D>& before, const Fibres<hn::TFromD<D>>& fibres,
                                                  const SectionMemory<hn::TFromD<D>>& place) {
  FibreCopy<kSections * kDepthPoints, kHardening, D> copy(fibres);
  const Fibres<hn::TFromD<D>> remembered = copy.fibres();
  LaneMemory<kSections, D> memory;
  memory.load(d, place);
  const auto straight = memory.is_straight(d);
  hn::Vec<D> curvature[kSections];
  straight_curvatures(d, rule, bend_start, bend_end, curvature);
  if (!hn::AllTrue(d, straight)) {
    hn::Vec<D> balanced[kSections];
    balanced_curvatures(d, rule, material, before, hn::Not(straight), bend_start, bend_end, memory, balanced);
    for (int i = 0; i < kSections; ++i) {
      curvature[i] = hn::IfThenElse(straight, curvature[i], balanced[i]);
    }
  }
  auto element = return_element<kHardening>(d, material, rule, membrane, curvature, remembered, fibres);
  auto active = hn::Not(hn::And(straight, hn::Eq(element.plastic_work, hn::Zero(d))));
  if (hn::AllFalse(d, active)) {
    return element;  // elastic: in balance by themselves, and nothing to remember
  }
  hn::Vec<D> moment_before[kSections];
  for (int i = 0; i < kSections; ++i) {
    moment_before[i] = hn::Sub(before.at(d, rule.along[i]), memory.unbalance[i]);
  }
  for (int pass = 1;; ++pass) {
    const auto in_balance = remember_sections(d, rule, material, moment_before, element, curvature, active, memory);
    active = hn::AndNot(in_balance, active);
    if (pass == kMostPasses || hn::AllFalse(d, active)) {
      break;
    }
    hn::Vec<D> moved[kSections];
    balanced_curvatures(d, rule, material, element.moments, active, hn::Zero(d), hn::Zero(d), memory, moved);
    for (int i = 0; i < kSections; ++i) {
      curvature[i] = hn::Add(curvature[i], hn::IfThenElseZero(active, moved[i]));
    }
    element = return_element<kHardening>(d, material, rule, membrane, curvature, remembered, fibres);
  }
  memory.store(d, place);
  return element;
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // CELLCRUSH_BEAM_WALL_LANES_INL_H_

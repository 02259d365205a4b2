#include "scenes/kernels.h"

#include <algorithm>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "scenes/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "beam/cross_section-inl.h"
#include "beam/deformation-inl.h"
#include "beam/element_response-inl.h"

#ifndef CELLCRUSH_SCENES_KERNELS_ONCE
#define CELLCRUSH_SCENES_KERNELS_ONCE
namespace cellcrush::scenes {

/// What a kernel computes a step of an element with.
struct ElementStep {
  const Material& material;
  const SectionRule& rule;
  Fibres<double> fibres;
  double* unbalance;
  double* flexibility;
  double membrane;
  double bend_start;
  double bend_end;
  OneElement::Sums sums;  ///< before the step, then after it
};

}  // namespace cellcrush::scenes
#endif

HWY_BEFORE_NAMESPACE();
namespace cellcrush::HWY_NAMESPACE {

using One = hn::CappedTag<double, 1>;

HWY_INLINE Points<One> point(const Vector2& vector) { return Points<One>::load(&vector); }
HWY_INLINE double number(Lane<One> lane) { return hn::GetLane(lane.raw); }

double turn(const Vector2& from, const Vector2& to) { return number(turn_between(point(from), point(to))); }

scenes::ElementDeformation reverse(const Vector2& span, const Vector2& axis, double length, double turn_start,
                                   double turn_end) {
  const auto deformation = reverse_motion<One>(point(span), point(axis), length, 1.0 / length, turn_start, turn_end);
  return {number(deformation.stretch), number(deformation.rotation_start), number(deformation.rotation_end)};
}

double share_of_modulus(const Scene& scene, double length) {
  return number(CrossSection<One>(scene, 0).modulus_share(length));
}

void strain_element(scenes::ElementStep& step) {
  const RuleFactors<0, 0, double> rule(step.rule);
  const LaneMaterial<One> material(step.material);
  const Bend<One> bend = {step.bend_start, step.bend_end};
  const auto put = [&](const auto& sums) HWY_ATTR {
    step.sums = {number(sums.axial), number(sums.moments.start), number(sums.moments.end), number(sums.plastic_work)};
  };
  if (step.rule.force_based) {
    const EndMoments<One> before = {step.sums.moment_start, step.sums.moment_end};
    put(return_map_balanced<true>(material, rule, Lane<One>(step.membrane), bend, before, step.fibres,
                                  {step.unbalance, step.flexibility}));
  } else {
    Lane<One> curvature[kMostSections];
    straight_curvatures(rule, bend, curvature);
    put(return_map_element<true>(material, rule, Lane<One>(step.membrane), curvature, step.fibres, step.fibres));
  }
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(turn);
HWY_EXPORT(reverse);
HWY_EXPORT(share_of_modulus);
HWY_EXPORT(strain_element);

namespace scenes {

double turn_between(const Vector2& from, const Vector2& to) { return HWY_DYNAMIC_DISPATCH(turn)(from, to); }

ElementDeformation reverse_motion(const Vector2& span, const Vector2& previous_axis, double previous_length,
                                  double turn_start, double turn_end) {
  return HWY_DYNAMIC_DISPATCH(reverse)(span, previous_axis, previous_length, turn_start, turn_end);
}

double modulus_share(double length, double undeformed, double thickness) {
  Scene scene;
  scene.depth = 1.0;
  scene.walls.thickness = {thickness};
  scene.walls.undeformed_length = {undeformed};
  return HWY_DYNAMIC_DISPATCH(share_of_modulus)(scene, length);
}

OneElement::OneElement(const Material& material, const SectionRule& rule)
    : material_(material),
      rule_(rule),
      stress_(rule.fibre_count()),
      back_stress_(rule.fibre_count()),
      plastic_strain_(rule.fibre_count()),
      unbalance_(rule.section_count()),
      flexibility_(rule.section_count(), 1.0) {}

const OneElement::Sums& OneElement::strain(double membrane, double bend_start, double bend_end) {
  const Fibres<double> fibres = {stress_.data(), back_stress_.data(), plastic_strain_.data(), nullptr};
  ElementStep step = {material_,  rule_,    fibres, unbalance_.data(), flexibility_.data(), membrane,
                      bend_start, bend_end, sums_};
  HWY_DYNAMIC_DISPATCH(strain_element)(step);
  return sums_ = step.sums;
}

double OneElement::residual() const {
  double greatest = 0.0;
  for (const double moment : unbalance_) {
    greatest = std::max(greatest, std::abs(moment));
  }
  return greatest;
}

}  // namespace scenes
}  // namespace cellcrush
#endif

#include "scenes/kernels.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

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
  int elements;
  Fibres<double> fibres[2];
  double* section_axial[2];
  double* section_moment[2];
  std::uint64_t* yielding[2];
  StepStrains strains[2];
  Unit::Sums sums[2];  ///< after the step
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
  const CrossSection<One> section(scene, WallBlock{.walls = 1, .elements = 2}, 0);
  return number(section.modulus_share(length, 1.0 / length, section.thickening(length)));
}

ElementStrains<One> strains_of(const scenes::ElementStep& step, int e) {
  const scenes::StepStrains& of = step.strains[e];
  return {of.membrane, of.bend_start, of.bend_end};
}

void put_sums(const ElementSums<One>& of, scenes::Unit::Sums& sums) {
  sums = {number(of.axial), number(of.moment_start), number(of.moment_end), number(of.plastic_work)};
}

template <int kElements>
void strain_force_based(scenes::ElementStep& step) {
  const RuleFactors<0, 0, double> rule(step.rule);
  const LaneMaterial<One> material(step.material);
  UnitResponse<MixedHardening, kElements, RuleFactors<0, 0, double>, One> unit(rule, 0.0);
  for (int e = 0; e < kElements; ++e) {
    unit.set(e, material, material.modulus, false,
             {step.fibres[e], step.section_axial[e], step.section_moment[e], step.yielding[e]}, strains_of(step, e));
  }
  ElementSums<One> sums[kElements];
  unit.advance(sums);
  for (int e = 0; e < kElements; ++e) {
    put_sums(sums[e], step.sums[e]);
  }
}

void strain_unit(scenes::ElementStep& step) {
  if (!step.rule.force_based) {
    const RuleFactors<0, 0, double> rule(step.rule);
    const LaneMaterial<One> material(step.material);
    put_sums(return_map_element<MixedHardening>(material, rule, strains_of(step, 0), step.fibres[0], 0.0),
             step.sums[0]);
  } else {
    step.elements == 2 ? strain_force_based<2>(step) : strain_force_based<1>(step);
  }
}

}  // namespace cellcrush::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace cellcrush {

HWY_EXPORT(turn);
HWY_EXPORT(reverse);
HWY_EXPORT(share_of_modulus);
HWY_EXPORT(strain_unit);

namespace scenes {

double turn_between(const Vector2& from, const Vector2& to) { return HWY_DYNAMIC_DISPATCH(turn)(from, to); }

ElementDeformation reverse_motion(const Vector2& span, const Vector2& previous_axis, double previous_length,
                                  double turn_start, double turn_end) {
  return HWY_DYNAMIC_DISPATCH(reverse)(span, previous_axis, previous_length, turn_start, turn_end);
}

double modulus_share(double length, double undeformed, double thickness, bool in_pairs, double rotary) {
  Scene scene;
  scene.mass_scaling.rotary = rotary;
  scene.section.force_based = in_pairs;
  scene.depth = 1.0;
  scene.walls.thickness = {thickness};
  scene.walls.undeformed_length = {undeformed};
  scene.materials.resize(1);
  return HWY_DYNAMIC_DISPATCH(share_of_modulus)(scene, length);
}

Unit::Unit(const Material& material, const SectionRule& rule, int elements) : material_(material), rule_(rule) {
  const std::vector<double> of_fibres(rule.fibre_count());
  const std::vector<double> of_sections(rule.section_count());
  elements_.assign(elements, {of_fibres, of_fibres, of_fibres, of_sections, of_sections, 0, {}});
}

const Unit::Sums& Unit::strain(const std::vector<StepStrains>& strains) {
  ElementStep step = {material_, rule_, static_cast<int>(elements_.size()), {}, {}, {}, {}, {}, {}};
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    Element& element = elements_[e];
    step.fibres[e] = {element.stress.data(), element.back_stress.data(), element.plastic_strain.data(), nullptr};
    step.section_axial[e] = element.section_axial.data();
    step.section_moment[e] = element.section_moment.data();
    step.yielding[e] = &element.yielding;
    step.strains[e] = strains[e];
  }
  HWY_DYNAMIC_DISPATCH(strain_unit)(step);
  for (std::size_t e = 0; e < elements_.size(); ++e) {
    elements_[e].sums = step.sums[e];
  }
  return elements_[0].sums;
}

double Unit::residual() const {
  double greatest = 0.0;
  for (const Element& element : elements_) {
    for (std::size_t i = 0; i < rule_.section_count(); ++i) {
      const double s = rule_.along[static_cast<Eigen::Index>(i)];
      const double moment = (1.0 - s) * element.sums.moment_start - s * element.sums.moment_end;
      greatest = std::max({greatest, std::abs(element.section_axial[i] - element.sums.axial),
                           std::abs(element.section_moment[i] * 0.5 / std::numbers::sqrt3 - moment)});
    }
  }
  return greatest;
}

}  // namespace scenes
}  // namespace cellcrush
#endif

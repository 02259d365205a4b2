#include "cellcrush/fidelity.h"

#include "cellcrush/simulation.h"

namespace cellcrush {
namespace {

using Fidelity = NumericsSpec::Fidelity;

constexpr int kElementsPerWall = 2;  // where nothing is said

const FidelityPoint* find_point(Fidelity fidelity) {
  for (const FidelityPoint& point : fidelity_points()) {
    if (point.fidelity == fidelity) return &point;
  }
  return nullptr;
}

/// Fields by which a spec goes another way than a point that was measured.
std::vector<std::string> fields_beside(const FidelityPoint& point, const SceneSpec& spec) {
  std::vector<std::string> fields;
  const auto add_if = [&fields](bool other, const char* field) {
    if (other) fields.emplace_back(field);
  };
  const SectionSpec& section = spec.section;
  add_if(spec.elements_per_wall.value_or(point.elements_per_wall) != point.elements_per_wall, "elements_per_wall");
  add_if(section.formulation != SectionSpec::Formulation::force_based, "section.formulation");
  add_if(section.depth_rule != SectionSpec::DepthRule::full_moment, "section.depth_rule");
  add_if(section.area_rule != SectionSpec::AreaRule::constant_volume, "section.area_rule");
  add_if(section.axial_points.value_or(point.axial_points) != point.axial_points, "section.axial_points");
  add_if(section.depth_points.value_or(point.depth_points) != point.depth_points, "section.depth_points");
  add_if(spec.numerics.mass_scaling != 1.0, "numerics.mass_scaling");
  add_if(spec.numerics.rotary_scaling != 1.0, "numerics.rotary_scaling");
  return fields;
}

}  // namespace

SceneSpec fill_in_fidelity(const SceneSpec& spec) {
  SceneSpec filled = spec;
  SectionSpec& section = filled.section;
  const FidelityPoint* point = find_point(spec.numerics.fidelity);
  if (point != nullptr) {
    filled.elements_per_wall = spec.elements_per_wall.value_or(point->elements_per_wall);
    if (section.formulation == SectionSpec::Formulation::force_based) {
      section.axial_points = section.axial_points.value_or(point->axial_points);
    }
    if (section.depth_rule == SectionSpec::DepthRule::full_moment) {
      section.depth_points = section.depth_points.value_or(point->depth_points);
    }
  }
  filled.elements_per_wall = filled.elements_per_wall.value_or(kElementsPerWall);
  section.axial_points = section.axial_count();
  section.depth_points = section.depth_count();
  return filled;
}

std::string describe_fidelity(const SceneSpec& spec) {
  const FidelityPoint* point = find_point(spec.numerics.fidelity);
  if (point == nullptr) return {};
  const SceneSpec filled = fill_in_fidelity(spec);
  std::string fields;
  const auto add = [&fields](const char* field, const std::optional<int>& before, const std::optional<int>& after) {
    if (before) return;
    fields += std::string(fields.empty() ? " " : ", ") + field + " " + std::to_string(*after);
  };
  add("elements_per_wall", spec.elements_per_wall, filled.elements_per_wall);
  add("section.axial_points", spec.section.axial_points, filled.section.axial_points);
  add("section.depth_points", spec.section.depth_points, filled.section.depth_points);
  return "Fidelity " + point->name + " fills in" + (fields.empty() ? " nothing: all is given" : fields) + ".";
}

std::vector<FidelityForecast> forecast_fidelities(const SceneSpec& spec) {
  std::vector<FidelityForecast> forecasts;
  if (std::holds_alternative<FrameLattice>(spec.lattice)) return forecasts;
  for (const FidelityPoint& point : fidelity_points()) {
    SceneSpec asked = spec;
    asked.numerics.fidelity = point.fidelity;
    const SceneResult built = build_scene(asked);
    if (!built.scene) continue;
    const SceneFacts facts = facts_of(*built.scene);
    FidelityForecast forecast{point, facts.step_count, facts.element_count, fields_beside(point, spec)};
    if (!forecast.given.empty()) forecast.point.errors.clear();
    forecasts.push_back(std::move(forecast));
  }
  return forecasts;
}

}  // namespace cellcrush

#include "cellcrush/fidelity.h"

#include <algorithm>
#include <string>
#include <variant>

#include "cellcrush/simulation.h"
#include "scene/lattices.h"
#include "scene/measured_errors.h"

namespace cellcrush {
namespace {

using Fidelity = NumericsSpec::Fidelity;

/// Elements per wall of DRAFT, STANDARD and REFERENCE.
struct Meshes {
  int draft;
  int standard;
  int reference;
};

/// Hexagons with walls along the crush, in crushes faster than 2 elements per wall were found to be enough for.
bool is_fast_along_y(const SceneSpec& spec) {
  constexpr double kSlow = 25.0;  // m/s
  return std::holds_alternative<HexagonLattice>(spec.lattice) && spec.loading.direction == LoadingSpec::Direction::y &&
         spec.loading.speed_m_per_s.value_or(0.0) > kSlow;
}

bool is_force_based(const SceneSpec& spec) { return spec.section.formulation == SectionSpec::Formulation::force_based; }

// STANDARD is the coarsest mesh of force-based elements whose plateau stresses lie within 4 % (impact) and 10 %
// (support) of a mesh twice as fine, at 25 to 200 m/s. No mesh of squares does at every speed; theirs is that of
// triangles. Along y some differences of 8 elements exceed the bounds (core/what-is-computed.md). The elements of the
// paper keep the paper's mesh.
Meshes meshes_of(const SceneSpec& spec) {
  if (!is_force_based(spec)) return {1, 2, 8};
  if (has_walls_along_crush(spec)) return {8, 16, 32};
  return is_fast_along_y(spec) ? Meshes{2, 8, 16} : Meshes{1, 2, 8};
}

FidelityPoint point_of(const SceneSpec& spec) {
  const std::vector<FidelityPoint> points = fidelity_points(spec);
  const auto found = std::ranges::find(points, spec.numerics.fidelity, &FidelityPoint::fidelity);
  return found == points.end() ? points[1] : *found;
}

/// Fields that keep the measured errors from holding for a spec with this mesh.
std::vector<std::string> fields_beside(const SceneSpec& spec) {
  SceneSpec plain;
  std::vector<std::string> fields = fields_beside_measured(spec);
  const auto add_if = [&fields](bool other, const char* field) {
    if (other) fields.emplace_back(field);
  };
  add_if(!is_force_based(spec), "section.formulation");
  add_if(spec.section.depth_rule != plain.section.depth_rule, "section.depth_rule");
  add_if(spec.section.area_rule != plain.section.area_rule, "section.area_rule");
  add_if(is_force_based(spec) && spec.section.axial_count() != plain.section.axial_count(), "section.axial_points");
  add_if(is_force_based(spec) && spec.section.depth_count() != plain.section.depth_count(), "section.depth_points");
  add_if(spec.numerics.mass_scaling != plain.numerics.mass_scaling, "numerics.mass_scaling");
  add_if(spec.numerics.rotary_scaling != plain.numerics.rotary_scaling, "numerics.rotary_scaling");
  return fields;
}

}  // namespace

// The number of elements per wall trades time for accuracy at every speed, so it is all that a fidelity sets.
std::vector<FidelityPoint> fidelity_points(const SceneSpec& spec) {
  const Meshes meshes = meshes_of(spec);
  return {{Fidelity::draft, "DRAFT", meshes.draft},
          {Fidelity::standard, "STANDARD", meshes.standard},
          {Fidelity::reference, "REFERENCE", meshes.reference}};
}

// From tests/bench/results/work_precision.csv. With 16 and 32 elements per wall an element-step takes as long as with
// 8, as far as a shared machine tells (mesh_study.csv).
double step_cost_of(int elements_per_wall) {
  if (elements_per_wall < 4) return elements_per_wall == 1 ? 1.02 : 1.0;
  return elements_per_wall < 8 ? 0.9 : 1.05;
}

SceneSpec fill_in_fidelity(const SceneSpec& spec) {
  SceneSpec filled = spec;
  filled.elements_per_wall = spec.elements_per_wall.value_or(point_of(spec).elements_per_wall);
  return filled;
}

std::string describe_fidelity(const SceneSpec& spec) {
  if (std::holds_alternative<FrameLattice>(spec.lattice)) return {};
  const FidelityPoint point = point_of(spec);
  const bool names_one = spec.numerics.fidelity != Fidelity::unspecified;
  if (spec.elements_per_wall) {
    return names_one ? "Fidelity " + point.name + ": no effect, as elements_per_wall is given explicitly." : "";
  }
  const std::string mesh = "Mesh: elements_per_wall is " + std::to_string(point.elements_per_wall) + ", " + point.name;
  if (!is_force_based(spec)) return mesh + "; its error is not known for displacement-based elements.";
  if (has_walls_along_crush(spec)) {
    return mesh + " for squares and triangles, whose walls along the crush buckle in short waves.";
  }
  return mesh + (is_fast_along_y(spec) ? " for hexagons crushed along y faster than 25 m/s." : " for hexagons.");
}

std::vector<FidelityForecast> forecast_fidelities(const SceneSpec& spec, SpecChecker& checker) {
  std::vector<FidelityForecast> forecasts;
  if (std::holds_alternative<FrameLattice>(spec.lattice)) return forecasts;
  for (const FidelityPoint& point : fidelity_points(spec)) {
    SceneSpec asked = spec;
    asked.numerics.fidelity = point.fidelity;
    const SpecChecker::Verdict verdict = checker.check(asked);
    if (!verdict.problems.empty()) continue;
    FidelityForecast forecast{point, verdict.step_count, verdict.element_count, {}, fields_beside(spec)};
    forecast.point.elements_per_wall = *fill_in_fidelity(asked).elements_per_wall;
    if (forecast.given.empty()) forecast.errors = measured_errors_of(spec, forecast.point.elements_per_wall);
    forecasts.push_back(std::move(forecast));
  }
  return forecasts;
}

}  // namespace cellcrush

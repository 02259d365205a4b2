#include "cellcrush/fidelity.h"

#include <algorithm>
#include <string>
#include <variant>

#include "cellcrush/simulation.h"
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

/// Walls that lie along the crush buckle in half waves shorter than half a wall: squares and triangles.
bool has_walls_along_crush(const SceneSpec& spec) {
  return std::holds_alternative<SquareLattice>(spec.lattice) || std::holds_alternative<TriangleLattice>(spec.lattice);
}

bool is_force_based(const SceneSpec& spec) { return spec.section.formulation == SectionSpec::Formulation::force_based; }

// STANDARD of hexagons is the coarsest mesh of force-based elements whose plateau stresses lie within 4 % (impact) and
// 10 % (support) of a mesh twice as fine, crushed along x. By that rule 18 x 9 cells of squares and triangles need 16
// elements or more, which take four to five times as long as their 8 (tests/bench/results/mesh_study.csv and
// core/what-is-computed.md). The elements of the paper keep the paper's mesh.
Meshes meshes_of(const SceneSpec& spec) {
  return has_walls_along_crush(spec) && is_force_based(spec) ? Meshes{4, 8, 16} : Meshes{1, 2, 8};
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

// From tests/bench/results/work_precision.csv; more than 8 elements per wall were not timed.
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
  return mesh + (has_walls_along_crush(spec)
                     ? " for squares and triangles, whose walls along the crush buckle in short waves."
                     : " for hexagons.");
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

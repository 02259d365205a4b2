#include "cellcrush/fidelity.h"

#include "cellcrush/simulation.h"

namespace cellcrush {
namespace {

using Fidelity = NumericsSpec::Fidelity;

constexpr int kElementsPerWall = 2;  // default without a fidelity

const FidelityPoint* find_point(Fidelity fidelity) {
  for (const FidelityPoint& point : fidelity_points()) {
    if (point.fidelity == fidelity) return &point;
  }
  return nullptr;
}

/// Fields that a spec sets to other values than the measurement of a point, and that would change its error.
std::vector<std::string> fields_beside(const FidelityPoint& point, const SceneSpec& spec) {
  SceneSpec plain;
  plain.section.formulation = spec.section.formulation;
  std::vector<std::string> fields;
  const auto add_if = [&fields](bool other, const char* field) {
    if (other) fields.emplace_back(field);
  };
  add_if(spec.elements_per_wall.value_or(point.elements_per_wall) != point.elements_per_wall, "elements_per_wall");
  add_if(spec.section.formulation != SectionSpec().formulation, "section.formulation");
  add_if(spec.section.depth_rule != plain.section.depth_rule, "section.depth_rule");
  add_if(spec.section.area_rule != plain.section.area_rule, "section.area_rule");
  add_if(spec.section.axial_count() != plain.section.axial_count(), "section.axial_points");
  add_if(spec.section.depth_count() != plain.section.depth_count(), "section.depth_points");
  add_if(spec.numerics.mass_scaling != plain.numerics.mass_scaling, "numerics.mass_scaling");
  add_if(spec.numerics.rotary_scaling != plain.numerics.rotary_scaling, "numerics.rotary_scaling");
  return fields;
}

}  // namespace

// The number of elements per wall trades time for accuracy at every speed, so it is all that a fidelity sets.
// REFERENCE is the solution from which errors are measured; its own error is known up to the scatter of its seeds. Four
// elements per wall are no point of the front: they were found no closer to REFERENCE than two.
const std::vector<FidelityPoint>& fidelity_points() {
  const std::string fast = "support plateau, Type I, 100 m/s";
  const std::string slow = "limit stress, Example 1, 1 m/s";
  // From tests/bench/results/work_precision.csv.
  static const std::vector<FidelityPoint> kPoints = {
      {Fidelity::draft, "DRAFT", 1, 1.02, {{fast, 0.0940, 0.0116, 0.0111}, {slow, 0.0213, 0.0037, 0.001}}},
      {Fidelity::standard, "STANDARD", 2, 1.0, {{fast, 0.0127, 0.0036, 0.0029}, {slow, 0.0074, 0.0042, 0.001}}},
      {Fidelity::reference, "REFERENCE", 8, 1.05, {{fast, 0.0, 0.0023, 0.0018}, {slow, 0.0, 0.0054, 0.0022}}},
  };
  return kPoints;
}

SceneSpec fill_in_fidelity(const SceneSpec& spec) {
  const FidelityPoint* point = find_point(spec.numerics.fidelity);
  SceneSpec filled = spec;
  filled.elements_per_wall =
      spec.elements_per_wall.value_or(point != nullptr ? point->elements_per_wall : kElementsPerWall);
  return filled;
}

std::string describe_fidelity(const SceneSpec& spec) {
  const FidelityPoint* point = find_point(spec.numerics.fidelity);
  if (point == nullptr) return {};
  return "Fidelity " + point->name +
         (spec.elements_per_wall ? ": no effect, as elements_per_wall is given explicitly."
                                 : ": elements_per_wall is " + std::to_string(point->elements_per_wall) + ".");
}

std::vector<FidelityForecast> forecast_fidelities(const SceneSpec& spec, SpecChecker& checker) {
  std::vector<FidelityForecast> forecasts;
  if (std::holds_alternative<FrameLattice>(spec.lattice)) return forecasts;
  for (const FidelityPoint& point : fidelity_points()) {
    SceneSpec asked = spec;
    asked.numerics.fidelity = point.fidelity;
    const SpecChecker::Verdict verdict = checker.check(asked);
    if (!verdict.problems.empty()) continue;
    FidelityForecast forecast{point, verdict.step_count, verdict.element_count, fields_beside(point, spec)};
    forecast.point.elements_per_wall = *fill_in_fidelity(asked).elements_per_wall;
    if (!forecast.given.empty()) {
      forecast.point.errors.clear();
      forecast.point.step_cost = 1.0;
    }
    forecasts.push_back(std::move(forecast));
  }
  return forecasts;
}

}  // namespace cellcrush

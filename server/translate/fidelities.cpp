#include "translate/fidelities.h"

#include "cellcrush/fidelity.h"
#include "translate/case_to_spec.h"
#include "translate/measured_errors.h"
#include "translate/spec_to_case.h"

namespace cellcrush::translate {
namespace {

void write_errors(const SceneSpec& spec, v1::FidelityForecast& out) {
  const std::vector<std::string> beside = fields_beside_measured(spec);
  out.mutable_given_fields()->Assign(beside.begin(), beside.end());
  if (!beside.empty()) return;
  for (const MeasuredError& measured : measured_errors_of(spec, out.elements_per_wall())) {
    auto& error = *out.add_errors();
    error.set_measure(measured.measure);
    error.set_error_relative(measured.error);
    error.set_uncertainty_relative(measured.uncertainty);
    error.set_scatter_relative(measured.scatter);
  }
}

}  // namespace

void add_fidelities(const v1::Case& submitted, double step_cost, CaseCheck& check) {
  v1::CheckCaseResponse& response = check.response;
  const auto asked = submitted.numerics().fidelity();
  const auto decides = asked == v1::Numerics::FIDELITY_UNSPECIFIED ? v1::Numerics::STANDARD : asked;
  const SceneSpec spec = to_spec(submitted).spec;
  if (!std::holds_alternative<RegularLattice>(spec.lattice)) return;  // nothing was measured
  for (const FidelityPoint& point : fidelity_points(spec)) {
    SceneSpec tried = spec;
    tried.numerics.fidelity = point.fidelity;
    const SpecChecker::Verdict verdict = check.meshes->check(tried);
    if (!verdict.problems.empty()) continue;
    auto& forecast = *response.add_fidelities();
    forecast.set_fidelity(to_proto(point.fidelity));
    forecast.set_elements_per_wall(*fill_in_fidelity(tried).elements_per_wall);
    forecast.set_element_count(verdict.element_count);
    forecast.set_step_count(verdict.step_count);
    const double element_steps = static_cast<double>(verdict.element_count) * static_cast<double>(verdict.step_count);
    forecast.set_predicted_seconds(step_cost * step_cost_of(forecast.elements_per_wall()) * element_steps);
    write_errors(spec, forecast);
    if (decides == forecast.fidelity()) response.set_predicted_seconds(forecast.predicted_seconds());
  }
}

}  // namespace cellcrush::translate

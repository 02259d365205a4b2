#include "translate/fidelities.h"

#include "cellcrush/fidelity.h"
#include "translate/case_to_spec.h"
#include "translate/spec_to_case.h"

namespace cellcrush::translate {
namespace {

void write_forecast(const FidelityForecast& in, double step_cost, v1::FidelityForecast& out) {
  out.set_fidelity(to_proto(in.point.fidelity));
  out.set_elements_per_wall(in.point.elements_per_wall);
  out.set_element_count(in.element_count);
  out.set_step_count(in.step_count);
  const double element_steps = static_cast<double>(in.element_count) * static_cast<double>(in.step_count);
  out.set_predicted_seconds(step_cost * step_cost_of(in.point.elements_per_wall) * element_steps);
  for (const auto& measured : in.errors) {
    auto& error = *out.add_errors();
    error.set_measure(measured.measure);
    error.set_error_relative(measured.error);
    error.set_uncertainty_relative(measured.uncertainty);
    error.set_scatter_relative(measured.scatter);
  }
  for (const auto& field : in.given) out.add_given_fields(field);
}

}  // namespace

void add_fidelities(const v1::Case& submitted, double step_cost, CaseCheck& check) {
  v1::CheckCaseResponse& response = check.response;
  const auto asked = submitted.numerics().fidelity();
  const auto decides = asked == v1::Numerics::FIDELITY_UNSPECIFIED ? v1::Numerics::STANDARD : asked;
  for (const auto& forecast : forecast_fidelities(to_spec(submitted).spec, *check.meshes)) {
    auto& added = *response.add_fidelities();
    write_forecast(forecast, step_cost, added);
    if (decides == added.fidelity()) response.set_predicted_seconds(added.predicted_seconds());
  }
}

}  // namespace cellcrush::translate

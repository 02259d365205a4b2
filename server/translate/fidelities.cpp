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
  out.set_predicted_seconds(step_cost * in.point.step_cost * static_cast<double>(in.element_count) *
                            static_cast<double>(in.step_count));
  for (const auto& measured : in.point.errors) {
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
  for (const auto& forecast : forecast_fidelities(to_spec(submitted).spec, *check.meshes)) {
    auto& added = *response.add_fidelities();
    write_forecast(forecast, step_cost, added);
    if (submitted.numerics().fidelity() == added.fidelity()) response.set_predicted_seconds(added.predicted_seconds());
  }
}

}  // namespace cellcrush::translate

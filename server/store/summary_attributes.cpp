#include <google/protobuf/message.h>

#include <string>
#include <string_view>

#include "store/hdf5.h"
#include "store/result_layout.h"

namespace cellcrush::store {
namespace {

// "V" of CRUSH_MODE_V.
std::string mode_name(v1::Summary::CrushMode mode) {
  constexpr std::size_t kPrefix = std::string_view("CRUSH_MODE_").size();
  return v1::Summary::CrushMode_Name(mode).substr(kPrefix);
}

// A number of the message for each attribute; one that the message lacks has none.
void write_numbers(hid_t file, const std::string& prefix, const google::protobuf::Message& message) {
  const auto& descriptor = *message.GetDescriptor();
  const auto& reflection = *message.GetReflection();
  for (int i = 0; i < descriptor.field_count(); ++i) {
    const auto& field = *descriptor.field(i);
    if (field.has_presence() && !reflection.HasField(message, &field)) continue;
    write_attribute(file, (prefix + std::string(field.name())).c_str(), reflection.GetDouble(message, &field));
  }
}

void write_collapse(hid_t file, const v1::Summary& summary) {
  write_attribute(file, "crush_mode", mode_name(summary.crush_mode()));
  if (summary.has_crush_mode_strain()) write_attribute(file, "crush_mode_strain", summary.crush_mode_strain());
  if (summary.has_solid_fraction_at_densification())
    write_attribute(file, "solid_fraction_at_densification", summary.solid_fraction_at_densification());
  if (summary.has_shock_error_relative())
    write_attribute(file, "theory_shock_error_relative", summary.shock_error_relative());
  if (summary.has_front()) write_numbers(file, "front_", summary.front());
  if (summary.has_quasi_static()) write_numbers(file, "quasi_static_", summary.quasi_static());
}

void write_warnings(hid_t file, const v1::Summary& summary) {
  std::string lines;
  for (const v1::Warning& warning : summary.warnings())
    lines += (lines.empty() ? "" : "\n") + v1::Warning::Kind_Name(warning.kind()) + ": " + warning.message();
  if (!lines.empty()) write_attribute(file, "warnings", lines);
}

}  // namespace

void write_summary_attributes(hid_t file, const v1::Summary& summary) {
  if (summary.has_plateau_stress_impact_mpa()) {
    write_attribute(file, "plateau_stress_impact_mpa", summary.plateau_stress_impact_mpa());
    write_attribute(file, "plateau_stress_mpa", summary.plateau_stress_impact_mpa());
  }
  if (summary.has_plateau_stress_support_mpa())
    write_attribute(file, "plateau_stress_support_mpa", summary.plateau_stress_support_mpa());
  write_attribute(file, "plateau_window_low", summary.plateau_window_low());
  write_attribute(file, "plateau_window_high", summary.plateau_window_high());
  if (summary.has_densification_strain()) write_attribute(file, "densification_strain", summary.densification_strain());
  if (summary.has_plateau_stress_to_densification_mpa())
    write_attribute(file, "plateau_stress_to_densification_mpa", summary.plateau_stress_to_densification_mpa());
  write_attribute(file, "absorbed_energy_mj", summary.absorbed_energy_mj());
  write_attribute(file, "energy_error_relative", summary.energy_error_relative());
  write_attribute(file, "deepest_penetration", summary.deepest_penetration());
  write_attribute(file, "step_count", static_cast<std::int64_t>(summary.step_count()));
  write_attribute(file, "solver_seconds", summary.solver_seconds());
  write_attribute(file, "theory_gibson_ashby_mpa", summary.theory().gibson_ashby_mpa());
  write_attribute(file, "theory_shock_mpa", summary.theory().shock_mpa());
  write_warnings(file, summary);
  write_collapse(file, summary);
  write_numbers(file, "ledger_", summary.ledger());
  write_numbers(file, "stage_", summary.stage_times());
}

}  // namespace cellcrush::store

#include "store/summary_attributes.h"

#include <string>
#include <string_view>

#include "store/hdf5.h"

namespace cellcrush::store {
namespace {

// "V" of CRUSH_MODE_V.
std::string mode_name(v1::Summary::CrushMode mode) {
  constexpr std::size_t kPrefix = std::string_view("CRUSH_MODE_").size();
  return v1::Summary::CrushMode_Name(mode).substr(kPrefix);
}

void write_front(hid_t file, const v1::FrontSummary& front) {
  write_attribute(file, "front_strain_behind", front.strain_behind());
  write_attribute(file, "front_strain_ahead", front.strain_ahead());
  write_attribute(file, "front_velocity_behind_m_per_s", front.velocity_behind_m_per_s());
  write_attribute(file, "front_velocity_ahead_m_per_s", front.velocity_ahead_m_per_s());
  write_attribute(file, "front_solid_fraction_behind", front.solid_fraction_behind());
  write_attribute(file, "front_wall_fraction_behind", front.wall_fraction_behind());
  write_attribute(file, "front_stress_ahead_mpa", front.stress_ahead_mpa());
  write_attribute(file, "front_shock_mpa", front.shock_mpa());
  if (front.has_shock_error_relative())
    write_attribute(file, "front_shock_error_relative", front.shock_error_relative());
  write_attribute(file, "front_window_share", front.window_share());
}

void write_collapse(hid_t file, const v1::Summary& summary) {
  write_attribute(file, "crush_mode", mode_name(summary.crush_mode()));
  if (summary.has_crush_mode_strain()) write_attribute(file, "crush_mode_strain", summary.crush_mode_strain());
  if (summary.has_solid_fraction_at_densification())
    write_attribute(file, "solid_fraction_at_densification", summary.solid_fraction_at_densification());
  if (summary.has_shock_error_relative())
    write_attribute(file, "theory_shock_error_relative", summary.shock_error_relative());
  if (summary.has_front()) write_front(file, summary.front());
  if (summary.has_quasi_static()) {
    const v1::QuasiStatic& quasi_static = summary.quasi_static();
    write_attribute(file, "quasi_static_plate_difference_relative", quasi_static.plate_difference_relative());
    write_attribute(file, "quasi_static_plate_difference_greatest", quasi_static.plate_difference_greatest());
    write_attribute(file, "quasi_static_kinetic_share", quasi_static.kinetic_share());
  }
}

void write_warnings(hid_t file, const v1::Summary& summary) {
  std::string lines;
  for (const v1::Warning& warning : summary.warnings())
    lines += (lines.empty() ? "" : "\n") + v1::Warning::Kind_Name(warning.kind()) + ": " + warning.message();
  if (!lines.empty()) write_attribute(file, "warnings", lines);
}

void write_ledger(hid_t file, const v1::Ledger& ledger) {
  write_attribute(file, "ledger_work_external_mj", ledger.work_external_mj());
  write_attribute(file, "ledger_kinetic_mj", ledger.kinetic_mj());
  write_attribute(file, "ledger_elastic_mj", ledger.elastic_mj());
  write_attribute(file, "ledger_plastic_mj", ledger.plastic_mj());
  write_attribute(file, "ledger_contact_mj", ledger.contact_mj());
  write_attribute(file, "ledger_friction_mj", ledger.friction_mj());
  write_attribute(file, "ledger_contact_damping_mj", ledger.contact_damping_mj());
  write_attribute(file, "ledger_mass_damping_mj", ledger.mass_damping_mj());
  write_attribute(file, "ledger_residual_mj", ledger.residual_mj());
}

void write_stage_times(hid_t file, const v1::StageTimes& times) {
  write_attribute(file, "stage_integrate_motion_s", times.integrate_motion_s());
  write_attribute(file, "stage_evaluate_internal_forces_s", times.evaluate_internal_forces_s());
  write_attribute(file, "stage_find_contacts_s", times.find_contacts_s());
  write_attribute(file, "stage_evaluate_contact_forces_s", times.evaluate_contact_forces_s());
  write_attribute(file, "stage_evaluate_plate_forces_s", times.evaluate_plate_forces_s());
  write_attribute(file, "stage_evaluate_loads_s", times.evaluate_loads_s());
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
  write_ledger(file, summary.ledger());
  write_stage_times(file, summary.stage_times());
}

}  // namespace cellcrush::store

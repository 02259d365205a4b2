#include "translate/results.h"

namespace cellcrush::translate {

v1::Sample to_proto(const Sample& sample, const google::protobuf::RepeatedPtrField<std::string>& watched_ids) {
  v1::Sample out;
  out.set_step(sample.step);
  out.set_time_s(sample.time);
  out.set_travel_mm(sample.travel);
  out.set_strain(sample.strain);
  out.set_stress_impact_mpa(sample.stress_impact);
  out.set_stress_support_mpa(sample.stress_support);
  out.set_energy_kinetic_mj(sample.energy_kinetic);
  out.set_energy_elastic_mj(sample.energy_elastic);
  out.set_energy_plastic_mj(sample.energy_plastic);
  out.set_energy_contact_mj(sample.energy_contact);
  out.set_energy_friction_mj(sample.energy_friction);
  out.set_energy_damping_mj(sample.energy_damping);
  out.set_work_external_mj(sample.work_external);
  out.set_energy_residual_mj(sample.energy_residual);
  out.set_energy_contact_stored_mj(sample.energy_contact_stored);
  out.set_energy_contact_damping_mj(sample.energy_contact_damping);
  out.set_deepest_penetration(sample.deepest_penetration);
  out.set_contact_count(sample.contact_count);
  for (std::size_t i = 0; i < sample.watched.size(); ++i) {
    auto& watched = *out.add_watched();
    watched.set_node(watched_ids.Get(static_cast<int>(i)));
    watched.set_ux_mm(sample.watched[i].ux);
    watched.set_uy_mm(sample.watched[i].uy);
    watched.set_rotation_rad(sample.watched[i].rotation);
  }
  return out;
}

v1::FieldFrame to_proto(const FieldFrame& frame) {
  v1::FieldFrame out;
  out.set_index(frame.index);
  out.set_time_s(frame.time);
  out.set_strain(frame.strain);
  out.mutable_position_mm()->Assign(frame.position.begin(), frame.position.end());
  out.mutable_plastic_fraction()->Assign(frame.plastic_fraction.begin(), frame.plastic_fraction.end());
  return out;
}

v1::Mesh to_proto(const MeshView& mesh, std::int64_t particle_count) {
  v1::Mesh out;
  out.set_particle_count(static_cast<std::int32_t>(particle_count));
  out.mutable_element_nodes()->Assign(mesh.element_nodes.begin(), mesh.element_nodes.end());
  out.mutable_thickness_mm()->Assign(mesh.thickness.begin(), mesh.thickness.end());
  out.set_length_mm(mesh.length);
  out.set_width_mm(mesh.width);
  out.set_impact_plate_mm(mesh.impact_plate);
  out.set_support_plate_mm(mesh.support_plate);
  out.set_along_y(mesh.along_y);
  return out;
}

v1::Theory to_proto(const Theory& theory) {
  v1::Theory out;
  out.set_gibson_ashby_mpa(theory.gibson_ashby);
  out.set_shock_mpa(theory.shock);
  out.set_densification_strain(theory.densification_strain);
  return out;
}

v1::Summary to_proto(const Summary& summary, double solver_seconds) {
  v1::Summary out;
  if (summary.plateau_stress_impact) out.set_plateau_stress_impact_mpa(*summary.plateau_stress_impact);
  if (summary.plateau_stress_support) out.set_plateau_stress_support_mpa(*summary.plateau_stress_support);
  out.set_plateau_window_low(Summary::kPlateauLow);
  out.set_plateau_window_high(Summary::kPlateauHigh);
  if (summary.densification_strain) out.set_densification_strain(*summary.densification_strain);
  if (summary.plateau_stress_to_densification)
    out.set_plateau_stress_to_densification_mpa(*summary.plateau_stress_to_densification);
  out.set_absorbed_energy_mj(summary.absorbed_energy);
  out.set_energy_error_relative(summary.energy_error_relative);
  out.set_deepest_penetration(summary.deepest_penetration);
  out.set_step_count(summary.step_count);
  out.set_solver_seconds(solver_seconds);
  *out.mutable_theory() = to_proto(summary.theory);
  return out;
}

}  // namespace cellcrush::translate

#include "translate/results.h"

#include <google/protobuf/message.h>

#include <string>
#include <string_view>
#include <type_traits>

#include "cellcrush/lattice_moduli.h"
#include "columns/sample_parts.h"

namespace cellcrush::translate {
namespace {

// Sets the field that a column of the history is named after, if the message has it.
auto setter_of(google::protobuf::Message& message) {
  return [&message](std::string_view name, auto number, double scale) {
    const auto* field = message.GetDescriptor()->FindFieldByName(std::string(name));
    if (field == nullptr) return;
    if constexpr (std::is_integral_v<decltype(number)>)
      message.GetReflection()->SetInt64(&message, field, number);
    else
      message.GetReflection()->SetDouble(&message, field, scale * number);
  };
}

v1::Front to_proto(const Front& front) {
  v1::Front out;
  visit_columns_of_front(front, setter_of(out));
  return out;
}

v1::FrontSummary to_proto(const FrontSummary& front) {
  v1::FrontSummary out;
  visit_columns_of_front(front, setter_of(out));
  out.set_stress_ahead_mpa(front.stress_ahead);
  out.set_shock_mpa(front.shock);
  out.set_window_share(front.window_share);
  return out;
}

v1::QuasiStatic to_proto(const QuasiStatic& quasi_static) {
  v1::QuasiStatic out;
  out.set_plate_difference_relative(quasi_static.plate_difference);
  out.set_plate_difference_greatest(quasi_static.plate_difference_greatest);
  out.set_kinetic_share(quasi_static.kinetic_share);
  return out;
}

v1::CrushForces to_proto(const CrushForces& forces) {
  constexpr double kJPerGOfNMmPerTonne = 1e-9;
  v1::CrushForces out;
  out.set_mean_n(forces.mean);
  out.set_peak_n(forces.peak);
  out.set_efficiency(forces.efficiency());
  out.set_stroke_mm(forces.stroke);
  out.set_specific_energy_j_per_g(kJPerGOfNMmPerTonne * forces.specific_energy);
  return out;
}

v1::FibreStrain to_proto(const LargestFibreStrain& fibre_strain) {
  v1::FibreStrain out;
  out.set_largest(fibre_strain.largest);
  out.set_wall(fibre_strain.wall);
  out.set_x_mm(fibre_strain.x);
  out.set_y_mm(fibre_strain.y);
  out.set_nominal_strain(fibre_strain.strain);
  out.set_time_s(fibre_strain.time);
  return out;
}

v1::Break to_proto(const Break& broken) {
  v1::Break out;
  out.set_step(broken.step);
  out.set_time_s(broken.time);
  out.set_wall(broken.wall);
  out.set_x_mm(broken.place.x());
  out.set_y_mm(broken.place.y());
  out.set_energy_mj(broken.plastic);
  out.set_element(broken.element);
  out.set_at_end(broken.at_end != 0);
  out.set_particle(broken.particle);
  return out;
}

v1::Warning::Kind to_proto(Warning::Kind kind) {
  switch (kind) {
    case Warning::Kind::deep_penetration: return v1::Warning::DEEP_PENETRATION;
    case Warning::Kind::borders_near: return v1::Warning::BORDERS_NEAR;
    case Warning::Kind::walls_neck: return v1::Warning::WALLS_NECK;
    case Warning::Kind::denser_than_solid: return v1::Warning::DENSER_THAN_SOLID;
    case Warning::Kind::closed: return v1::Warning::CLOSED;
    case Warning::Kind::inertia: return v1::Warning::INERTIA;
    case Warning::Kind::energy_drift: return v1::Warning::ENERGY_DRIFT;
    case Warning::Kind::contact_energy: return v1::Warning::CONTACTS_MAKE_ENERGY;
  }
  return v1::Warning::WARNING_KIND_UNSPECIFIED;
}

v1::Warning to_proto(const Warning& warning) {
  v1::Warning out;
  out.set_kind(to_proto(warning.kind));
  out.set_step(warning.step);
  out.set_strain(warning.strain);
  out.set_message(warning.message);
  out.set_remedy(warning.remedy);
  return out;
}

v1::Summary::CrushMode to_proto(CrushMode mode) {
  switch (mode) {
    case CrushMode::none: return v1::Summary::CRUSH_MODE_NONE;
    case CrushMode::x: return v1::Summary::CRUSH_MODE_X;
    case CrushMode::v: return v1::Summary::CRUSH_MODE_V;
    case CrushMode::i: return v1::Summary::CRUSH_MODE_I;
    case CrushMode::c: return v1::Summary::CRUSH_MODE_C;
    case CrushMode::mixed: return v1::Summary::CRUSH_MODE_MIXED;
  }
  return v1::Summary::CRUSH_MODE_UNSPECIFIED;
}

v1::Summary::OtherRise to_proto(RiseKind kind) {
  switch (kind) {
    case RiseKind::densification: return v1::Summary::OTHER_RISE_UNSPECIFIED;
    case RiseKind::hardening: return v1::Summary::OTHER_RISE_HARDENING;
    case RiseKind::second_collapse: return v1::Summary::OTHER_RISE_SECOND_COLLAPSE;
    case RiseKind::stiffening: return v1::Summary::OTHER_RISE_STIFFENING;
  }
  return v1::Summary::OTHER_RISE_UNSPECIFIED;
}

v1::StageTimes to_proto(const std::array<double, kStageCount>& seconds) {
  v1::StageTimes out;
  const auto set = setter_of(out);
  for (int i = 0; i < kStageCount; ++i) set(std::string(kStageNames[i]) + "_s", seconds[i], 1.0);
  return out;
}

v1::RigidWallSummary to_proto(const RigidWallSummary& wall, const std::string& id) {
  v1::RigidWallSummary out;
  out.set_wall(id);
  out.set_peak_force_n(wall.peak_force);
  out.set_peak_force_time_s(wall.peak_time);
  out.set_peak_deceleration_m_per_s2(wall.peak_deceleration / kMmPerM);
  out.set_stroke_mm(wall.stroke);
  out.set_end_velocity_m_per_s(wall.speed / kMmPerM);
  out.set_impulse_n_s(wall.impulse);
  out.set_work_mj(wall.work);
  return out;
}

// A term X_mj of the ledger is the sample's energy_X_mj or X_mj.
v1::Ledger ledger_of(const Sample& sample) {
  v1::Ledger out;
  const auto set = setter_of(out);
  visit_columns(sample, [&](std::string_view name, auto number, double scale) {
    constexpr std::string_view kEnergy = "energy_";
    if (name.starts_with(kEnergy)) name.remove_prefix(kEnergy.size());
    set(name, number, scale);
  });
  return out;
}

}  // namespace

v1::Sample to_proto(const Sample& sample, const v1::Case& scene) {
  v1::Sample out = sample_parts_of(scene);
  visit_columns(sample, setter_of(out));
  out.set_energy_damping_mj(sample.energy_damping());
  if (sample.front) *out.mutable_front() = to_proto(*sample.front);
  for (std::size_t i = 0; i < sample.watched.size(); ++i) {
    auto& watched = *out.mutable_watched(static_cast<int>(i));
    watched.set_ux_mm(sample.watched[i].ux);
    watched.set_uy_mm(sample.watched[i].uy);
    watched.set_rotation_rad(sample.watched[i].rotation);
    watched.set_reaction_x_n(sample.watched[i].reaction_x);
    watched.set_reaction_y_n(sample.watched[i].reaction_y);
    watched.set_reaction_moment_n_mm(sample.watched[i].reaction_moment);
  }
  for (std::size_t i = 0; i < sample.rigid_walls.size(); ++i) {
    auto& wall = *out.mutable_rigid_walls(static_cast<int>(i));
    wall.set_displacement_mm(sample.rigid_walls[i].displacement);
    wall.set_normal_force_n(sample.rigid_walls[i].normal_force);
    wall.set_tangential_force_n(sample.rigid_walls[i].tangential_force);
    wall.set_velocity_m_per_s(sample.rigid_walls[i].speed / kMmPerM);
    wall.set_acceleration_m_per_s2(sample.rigid_walls[i].acceleration / kMmPerM);
    wall.set_impulse_n_s(sample.rigid_walls[i].impulse);
    wall.set_work_mj(sample.rigid_walls[i].work);
  }
  for (std::size_t i = 0; i < sample.grips.size(); ++i) {
    auto& grip = *out.mutable_grips(static_cast<int>(i));
    grip.set_displacement_x_mm(sample.grips[i].displacement_x);
    grip.set_displacement_y_mm(sample.grips[i].displacement_y);
    grip.set_force_x_n(sample.grips[i].force_x);
    grip.set_force_y_n(sample.grips[i].force_y);
  }
  for (const Break& broken : sample.breaks) *out.add_breaks() = to_proto(broken);
  for (const Warning& warning : sample.warnings) *out.add_warnings() = to_proto(warning);
  return out;
}

v1::Job::Cause cause_of(RunStatus::Kind kind) {
  switch (kind) {
    case RunStatus::Kind::running:
    case RunStatus::Kind::finished: return v1::Job::JOB_CAUSE_UNSPECIFIED;
    case RunStatus::Kind::diverged: return v1::Job::SOLVER_DIVERGED;
    case RunStatus::Kind::large_rotation: return v1::Job::LARGE_ROTATION;
    case RunStatus::Kind::energy_balance: return v1::Job::ENERGY_BALANCE;
    case RunStatus::Kind::contact_energy: return v1::Job::CONTACT_ENERGY;
    case RunStatus::Kind::wall_crossing: return v1::Job::WALL_CROSSING;
    case RunStatus::Kind::inertia: return v1::Job::INERTIA;
    case RunStatus::Kind::overcompaction: return v1::Job::OVERCOMPACTION;
    case RunStatus::Kind::contact_lost: return v1::Job::CONTACT_LOST;
  }
  return v1::Job::JOB_CAUSE_UNSPECIFIED;
}

v1::FieldFrame to_proto(const FieldFrame& frame) {
  v1::FieldFrame out;
  out.set_index(frame.index);
  out.set_time_s(frame.time);
  out.set_strain(frame.strain);
  out.mutable_position_mm()->Assign(frame.position.begin(), frame.position.end());
  out.mutable_plastic_fraction()->Assign(frame.plastic_fraction.begin(), frame.plastic_fraction.end());
  out.mutable_fibre_strain()->Assign(frame.fibre_strain.begin(), frame.fibre_strain.end());
  out.mutable_local_strain()->Assign(frame.local_strain.begin(), frame.local_strain.end());
  out.mutable_broken_end()->Assign(frame.broken_end.begin(), frame.broken_end.end());
  out.mutable_end_position_mm()->Assign(frame.end_position.begin(), frame.end_position.end());
  return out;
}

v1::Mesh to_proto(const MeshView& mesh) {
  v1::Mesh out;
  out.set_particle_count(static_cast<std::int32_t>(mesh.position.size() / 2));
  out.mutable_position_mm()->Assign(mesh.position.begin(), mesh.position.end());
  out.mutable_element_nodes()->Assign(mesh.element_nodes.begin(), mesh.element_nodes.end());
  out.mutable_thickness_mm()->Assign(mesh.thickness.begin(), mesh.thickness.end());
  out.mutable_element_wall()->Assign(mesh.element_wall.begin(), mesh.element_wall.end());
  out.set_rigid_element_count(mesh.rigid_elements);
  out.mutable_overlap_particle()->Assign(mesh.overlap_particle.begin(), mesh.overlap_particle.end());
  out.set_length_mm(mesh.length);
  out.set_width_mm(mesh.width);
  out.set_impact_plate_mm(mesh.impact_plate);
  out.set_support_plate_mm(mesh.support_plate);
  out.set_along_y(mesh.along_y);
  out.set_side_low_mm(mesh.side_low);
  out.set_side_high_mm(mesh.side_high);
  out.mutable_gripped()->Assign(mesh.gripped.begin(), mesh.gripped.end());
  return out;
}

v1::Theory to_proto(const Theory& theory) {
  v1::Theory out;
  out.set_gibson_ashby_mpa(theory.gibson_ashby);
  out.set_shock_mpa(theory.shock);
  out.set_densification_strain(theory.densification_strain);
  return out;
}

void add_moduli(const SceneSpec& spec, v1::Theory& out) {
  const auto moduli = elastic_moduli_of(spec);
  if (!moduli) return;
  out.set_modulus_mpa(moduli->along.modulus);
  out.set_poissons_ratio(moduli->along.poissons_ratio);
  out.set_modulus_across_mpa(moduli->across.modulus);
  out.set_poissons_ratio_across(moduli->across.poissons_ratio);
}

v1::Summary::End to_proto(RunEnd end) {
  switch (end) {
    case RunEnd::strain: return v1::Summary::END_STRAIN;
    case RunEnd::closed: return v1::Summary::END_CLOSED;
    case RunEnd::time: return v1::Summary::END_TIME;
    case RunEnd::at_rest: return v1::Summary::END_AT_REST;
  }
  return v1::Summary::END_UNSPECIFIED;
}

v1::Summary to_proto(const Summary& summary, const Sample& last, const RunTime& time, const v1::Case& scene) {
  v1::Summary out;
  if (summary.valid_to_strain) out.set_valid_to_strain(*summary.valid_to_strain);
  if (summary.valid_to_time) out.set_valid_to_time_s(*summary.valid_to_time);
  out.set_end(to_proto(summary.end));
  if (summary.inertia_share) out.set_inertia_share(*summary.inertia_share);
  if (summary.plateau_stress_impact) out.set_plateau_stress_impact_mpa(*summary.plateau_stress_impact);
  if (summary.plateau_stress_support) out.set_plateau_stress_support_mpa(*summary.plateau_stress_support);
  out.set_plateau_window_low(Summary::kPlateauLow);
  out.set_plateau_window_high(Summary::kPlateauHigh);
  out.set_peak_stress_window(Summary::kPeakWindow);
  if (summary.peak) {
    out.set_peak_stress_mpa(summary.peak->stress);
    out.set_peak_stress_strain(summary.peak->strain);
  }
  if (summary.crush_forces) *out.mutable_crush_forces() = to_proto(*summary.crush_forces);
  if (summary.poissons_ratio) out.set_poissons_ratio(*summary.poissons_ratio);
  if (summary.densification_strain) out.set_densification_strain(*summary.densification_strain);
  if (summary.other_rise) {
    out.set_other_rise(to_proto(summary.other_rise->kind));
    out.set_other_rise_strain(summary.other_rise->strain);
  }
  if (summary.plateau_stress_to_densification)
    out.set_plateau_stress_to_densification_mpa(*summary.plateau_stress_to_densification);
  out.set_absorbed_energy_mj(summary.absorbed_energy);
  out.set_energy_error_relative(summary.energy_error_relative);
  out.set_deepest_penetration(summary.deepest_penetration);
  for (const Warning& warning : summary.warnings) *out.add_warnings() = to_proto(warning);
  out.set_step_count(summary.step_count);
  out.set_rigid_link_count(summary.rigid_link_count);
  out.set_start_overlap_count(summary.start_overlap_count);
  out.set_solver_seconds(time.processor);
  *out.mutable_theory() = to_proto(summary.theory);
  out.set_crush_mode(to_proto(summary.crush_mode));
  if (summary.crush_mode_strain) out.set_crush_mode_strain(*summary.crush_mode_strain);
  if (summary.front) *out.mutable_front() = to_proto(*summary.front);
  if (const auto error = summary.front_shock_error()) out.mutable_front()->set_shock_error_relative(*error);
  if (const auto error = summary.shock_error()) out.set_shock_error_relative(*error);
  if (summary.solid_fraction_at_densification)
    out.set_solid_fraction_at_densification(*summary.solid_fraction_at_densification);
  if (summary.fibre_strain) *out.mutable_fibre_strain() = to_proto(*summary.fibre_strain);
  if (summary.quasi_static) *out.mutable_quasi_static() = to_proto(*summary.quasi_static);
  const v1::Sample names = sample_parts_of(scene);
  for (std::size_t i = 0; i < summary.rigid_walls.size(); ++i) {
    *out.add_rigid_walls() = to_proto(summary.rigid_walls[i], names.rigid_walls(static_cast<int>(i)).wall());
  }
  out.set_break_count(summary.break_count);
  if (summary.first_break) {
    out.set_first_break_time_s(summary.first_break->time);
    out.set_first_break_strain(summary.first_break->strain);
  }
  *out.mutable_ledger() = ledger_of(last);
  *out.mutable_stage_times() = to_proto(time.stages);
  return out;
}

}  // namespace cellcrush::translate

#include "translate/spec_to_case.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <string>
#include <variant>

#include "translate/loads_places.h"

namespace cellcrush::translate {
namespace {

// The message of any lattice of equal cells, as case_to_spec.cpp reads it.
void write_regular(const RegularLattice& in, v1::Lattice& out) {
  const auto* kind = out.GetDescriptor()->FindFieldByName(in.kind);
  google::protobuf::Message& message = *out.GetReflection()->MutableMessage(&out, kind);
  const google::protobuf::Reflection& reflection = *message.GetReflection();
  const auto field = [&](const std::string& name) { return message.GetDescriptor()->FindFieldByName(name); };
  if (in.columns) reflection.SetInt32(&message, field("columns"), *in.columns);
  if (in.rows) reflection.SetInt32(&message, field("rows"), *in.rows);
  if (in.side_mm) reflection.SetDouble(&message, field("side_mm"), *in.side_mm);
  if (in.wall_thickness_mm) reflection.SetDouble(&message, field("wall_thickness_mm"), *in.wall_thickness_mm);
  for (const auto& [name, value] : in.own) reflection.SetDouble(&message, field(name), value);
}

// The value of the wire; the enum of the spec lists the same values in the same order, from `first` on.
template <class Wire, class In>
Wire wire_of(In value, In first = In()) {
  return static_cast<Wire>(1 + static_cast<int>(value) - static_cast<int>(first));
}

void write_material(const MaterialSpec& in, v1::Material& out) {
  if (in.youngs_modulus_mpa) out.set_youngs_modulus_mpa(*in.youngs_modulus_mpa);
  if (in.yield_stress_mpa) out.set_yield_stress_mpa(*in.yield_stress_mpa);
  for (const LawParameter& parameter : kLawParameters) {
    out.GetReflection()->SetDouble(&out, out.GetDescriptor()->FindFieldByName(parameter.name), in.*parameter.value);
  }
  if (in.density_kg_per_m3) out.set_density_kg_per_m3(*in.density_kg_per_m3);
  out.set_plane(wire_of<v1::Material::Plane>(in.plane));
  out.set_poissons_ratio(in.poissons_ratio);
  if (const HardeningTable& table = in.hardening_table; !table.stresses_mpa.empty()) {
    auto& curve = *out.mutable_hardening_table();
    curve.mutable_plastic_strains()->Add(table.plastic_strains.begin(), table.plastic_strains.end());
    curve.mutable_stresses_mpa()->Add(table.stresses_mpa.begin(), table.stresses_mpa.end());
    curve.set_beyond(wire_of<v1::Material::HardeningTable::Beyond>(table.beyond));
  }
  if (const RateTable& table = in.rate_table; !table.factors.empty()) {
    auto& rates = *out.mutable_rate_table();
    rates.mutable_rates_per_s()->Add(table.rates_per_s.begin(), table.rates_per_s.end());
    rates.mutable_factors()->Add(table.factors.begin(), table.factors.end());
  }
}

void write_function(const LoadsSpec::TimeFunction& in, v1::Frame::TimeFunction& out) {
  for (const auto& [time, value] : in) {
    auto& point = *out.add_points();
    point.set_time_s(time);
    point.set_value(value);
  }
}

void write_frame(const FrameWalls& in, v1::Frame& out) {
  for (std::size_t i = 0; i < in.nodes.size(); ++i) {
    auto& node = *out.add_nodes();
    node.set_id(std::to_string(i));
    node.set_x_mm(in.nodes[i].x_mm);
    node.set_y_mm(in.nodes[i].y_mm);
    node.set_attached_mass_g(in.nodes[i].attached_mass_g);
    node.set_attached_inertia_g_mm2(in.nodes[i].attached_inertia_g_mm2);
  }
  for (const auto& beam : in.beams) {
    auto& added = *out.add_beams();
    added.set_start(std::to_string(beam.start));
    added.set_end(std::to_string(beam.end));
    added.set_thickness_mm(beam.thickness_mm);
    if (beam.elements) added.set_elements(*beam.elements);
    if (beam.pin_start) added.set_pin_start(true);
    if (beam.pin_end) added.set_pin_end(true);
    if (beam.material) write_material(*beam.material, *added.mutable_material());
  }
  for (const auto& support : in.supports) {
    auto& added = *out.add_supports();
    added.set_node(std::to_string(support.node));
    added.set_fix_x(support.fix_x);
    added.set_fix_y(support.fix_y);
    added.set_fix_rotation(support.fix_rotation);
  }
  out.set_self_contact(in.self_contact);
  for (const int node : in.watched_nodes) out.add_watched_nodes(std::to_string(node));
}

void write_node_loads(const LoadsSpec& in, v1::Frame& out) {
  for (const auto& load : in.loads) {
    auto& added = *out.add_loads();
    added.set_node(std::to_string(load.node));
    added.set_component(wire_of<v1::Frame::Component>(load.component));
    write_function(load.points, *added.mutable_force_n_or_n_mm());
  }
  for (const auto& motion : in.motions) {
    auto& added = *out.add_motions();
    added.set_node(std::to_string(motion.node));
    added.set_component(wire_of<v1::Frame::Component>(motion.component));
    write_function(motion.points, *added.mutable_displacement_mm_or_rad());
  }
  for (const auto& load : in.distributed_loads) {
    auto& added = *out.add_distributed_loads();
    added.set_beam(load.beam);
    if (!load.x_points.empty()) write_function(load.x_points, *added.mutable_x_n_per_mm());
    if (!load.y_points.empty()) write_function(load.y_points, *added.mutable_y_n_per_mm());
  }
  for (const auto& velocity : in.initial_velocities) {
    auto& added = *out.add_initial_velocities();
    added.set_node(std::to_string(velocity.node));
    added.set_x_m_per_s(velocity.x_m_per_s);
    added.set_y_m_per_s(velocity.y_m_per_s);
    added.set_rotation_rad_per_s(velocity.rotation_rad_per_s);
  }
}

void write_network(const NetworkWalls& in, v1::Lattice::Network& out) {
  out.mutable_joints_mm()->Assign(in.joints_mm.begin(), in.joints_mm.end());
  out.mutable_walls()->Assign(in.walls.begin(), in.walls.end());
  if (in.wall_thickness_mm) out.set_wall_thickness_mm(*in.wall_thickness_mm);
  out.mutable_thicknesses_mm()->Assign(in.thicknesses_mm.begin(), in.thicknesses_mm.end());
  out.mutable_rises_mm()->Assign(in.rises_mm.begin(), in.rises_mm.end());
  for (const MaterialSpec& material : in.materials) write_material(material, *out.add_materials());
  out.mutable_wall_materials()->Assign(in.wall_materials.begin(), in.wall_materials.end());
}

void write_voronoi(const VoronoiWalls& in, v1::Lattice::Voronoi& out) {
  if (in.columns) out.set_columns(*in.columns);
  if (in.rows) out.set_rows(*in.rows);
  if (in.side_mm) out.set_side_mm(*in.side_mm);
  if (in.irregularity) out.set_irregularity(*in.irregularity);
  out.set_relaxation_steps(in.relaxation_steps);
  out.set_seed(in.seed);
  if (in.wall_thickness_mm) out.set_wall_thickness_mm(*in.wall_thickness_mm);
  if (in.relative_density) out.set_relative_density(*in.relative_density);
  out.set_edge_walls(in.edge_walls);
}

void write_changes(const LatticeChanges& in, v1::Lattice& out) {
  if (in.defects != Defects()) {
    out.mutable_defects()->set_missing_walls(in.defects.missing_walls);
    out.mutable_defects()->set_thickness_scatter(in.defects.thickness_scatter);
    out.mutable_defects()->set_seed(in.defects.seed);
  }
  if (in.grading != Grading()) {
    v1::Lattice::Grading& grading = *out.mutable_grading();
    grading.set_axis(wire_of<v1::Loading::Direction>(in.grading.axis));
    const auto copy = [](const std::vector<double>& from, auto& to) { to.Assign(from.begin(), from.end()); };
    copy(in.grading.thickness_steps, *grading.mutable_thickness_steps());
    copy(in.grading.thickness_polynomial, *grading.mutable_thickness_polynomial());
    copy(in.grading.size_steps, *grading.mutable_size_steps());
    copy(in.grading.size_polynomial, *grading.mutable_size_polynomial());
  }
  if (in.rotation_degrees != 0.0) out.set_rotation_degrees(in.rotation_degrees);
  if (in.outline != Outline()) {
    out.mutable_outline()->mutable_corners_mm()->Assign(in.outline.corners_mm.begin(), in.outline.corners_mm.end());
    out.mutable_outline()->set_edge_wall_thickness_mm(in.outline.edge_wall_thickness_mm);
  }
}

void write_lattice(const SceneSpec& spec, v1::Lattice& out) {
  if (const auto* regular = std::get_if<RegularLattice>(&spec.lattice)) {
    write_regular(*regular, out);
  } else if (const auto* network = std::get_if<NetworkWalls>(&spec.lattice)) {
    write_network(*network, *out.mutable_network());
  } else if (const auto* voronoi = std::get_if<VoronoiWalls>(&spec.lattice)) {
    write_voronoi(*voronoi, *out.mutable_voronoi());
  } else if (const auto* frame = std::get_if<FrameWalls>(&spec.lattice)) {
    write_frame(*frame, *out.mutable_frame());
    write_node_loads(spec.loads, *out.mutable_frame());
  }
  out.mutable_imperfection()->set_amplitude_mm(spec.imperfection.amplitude_mm);
  out.mutable_imperfection()->set_bow_mm(spec.imperfection.bow_mm);
  out.mutable_imperfection()->set_seed(spec.imperfection.seed);
  write_changes(spec.changes, out);
  if (!spec.inclusions.rows.empty()) {
    out.mutable_inclusions()->mutable_rows()->Assign(spec.inclusions.rows.begin(), spec.inclusions.rows.end());
    out.mutable_inclusions()->set_thickness_factor(spec.inclusions.thickness_factor);
    out.mutable_inclusions()->set_model(wire_of<v1::Lattice::Inclusions::Model>(spec.inclusions.model));
  }
}

void write_plates(const LoadingSpec& in, v1::Loading& out) {
  out.set_direction(wire_of<v1::Loading::Direction>(in.direction));
  if (in.speed_m_per_s) out.set_speed_m_per_s(*in.speed_m_per_s);
  if (in.quasi_static) {
    out.set_quasi_static(true);
    out.set_kinetic_share(in.kinetic_share);
  }
  if (in.end_strain) out.set_end_strain(*in.end_strain);
  out.set_ramp_strain(in.ramp_strain);
}

void write_grip(const LoadsSpec::Grip& in, v1::Loading::Grip& out) {
  out.set_edge(wire_of<v1::Loading::Grip::Edge>(in.edge));
  if (in.line_mm) out.set_line_mm(*in.line_mm);
  out.set_fixed_to(wire_of<v1::Loading::Grip::FixedTo>(in.fixed_to));
  if (!in.x_points.empty()) write_function(in.x_points, *out.mutable_displacement_x_mm());
  if (!in.y_points.empty()) write_function(in.y_points, *out.mutable_displacement_y_mm());
}

void write_loads(const SceneSpec& spec, v1::Case& out) {
  const bool listed = out.lattice().has_frame();
  v1::Loading& loading = *out.mutable_loading();
  if (spec.loading.end_time_s) loading.set_end_time_s(*spec.loading.end_time_s);
  if (spec.loading.end_at_rest > 0.0) loading.set_end_at_rest(spec.loading.end_at_rest);
  if (listed || spec.loads.gravity_x_m_per_s2 != 0.0) loading.set_gravity_x_m_per_s2(spec.loads.gravity_x_m_per_s2);
  if (listed || spec.loads.gravity_y_m_per_s2 != 0.0) loading.set_gravity_y_m_per_s2(spec.loads.gravity_y_m_per_s2);
  if (spec.loads.velocity_x_m_per_s != 0.0) loading.set_velocity_x_m_per_s(spec.loads.velocity_x_m_per_s);
  if (spec.loads.velocity_y_m_per_s != 0.0) loading.set_velocity_y_m_per_s(spec.loads.velocity_y_m_per_s);
  for (std::size_t i = 0; i < spec.loads.rigid_walls.size(); ++i) {
    const LoadsSpec::RigidWall& wall = spec.loads.rigid_walls[i];
    v1::Frame::RigidWall& added = *loading.add_rigid_walls();
    added.set_id(std::to_string(i));
    if (wall.edge) {
      added.set_edge(wire_of<v1::Loading::Grip::Edge>(*wall.edge));
    } else {
      added.set_x_mm(wall.x_mm);
      added.set_y_mm(wall.y_mm);
      added.set_normal_x(wall.normal_x);
      added.set_normal_y(wall.normal_y);
    }
    added.set_friction(wall.friction);
    if (!wall.points.empty()) write_function(wall.points, *added.mutable_displacement_mm());
    for (const auto& [name, value] : wall.own)
      added.GetReflection()->SetDouble(&added, added.GetDescriptor()->FindFieldByName(name), value);
    for (const auto& [name, points] : wall.functions) {
      auto* function = added.GetReflection()->MutableMessage(&added, added.GetDescriptor()->FindFieldByName(name));
      write_function(points, static_cast<v1::Frame::TimeFunction&>(*function));
    }
  }
  if (spec.loading.sides.kind != LoadingSpec::Sides::Kind::free) {
    loading.mutable_sides()->set_kind(wire_of<v1::Loading::Sides::Kind>(spec.loading.sides.kind));
    if (spec.loading.sides.kind == LoadingSpec::Sides::Kind::rigid)
      loading.mutable_sides()->set_friction(spec.loading.sides.friction);
    if (spec.loading.sides.kind == LoadingSpec::Sides::Kind::periodic)
      loading.mutable_sides()->set_fixed_width(spec.loading.sides.fixed_width);
    if (spec.loading.sides.period_mm) loading.mutable_sides()->set_period_mm(*spec.loading.sides.period_mm);
  }
  for (const LoadsSpec::Grip& grip : spec.loads.grips) write_grip(grip, *loading.add_grips());
  move_to_frame(out);
  if (loading.ByteSizeLong() == 0) out.clear_loading();
}

void write_section(const SectionSpec& in, v1::Section& out) {
  // Left unset where the formulation decides: changing a preset's formulation then also changes its points.
  if (in.axial_points) out.set_axial_points(*in.axial_points);
  out.set_depth_points(in.depth_count());
  out.set_formulation(wire_of<v1::Section::Formulation>(in.formulation));
  out.set_depth_rule(wire_of<v1::Section::DepthRule>(in.depth_rule));
  out.set_area_rule(wire_of<v1::Section::AreaRule>(in.area_rule));
  if (in.shear_deformation) {
    out.set_shear_deformation(true);
    out.set_shear_factor(in.shear_factor);
  }
  if (in.rigid_joints) out.set_rigid_joints(true);
  if (in.coupled_bending) out.set_coupled_bending(true);
}

void write_numerics(const NumericsSpec& in, v1::Numerics& out) {
  out.set_time_step_s(in.time_step_s);
  out.set_mass_damping_per_s(in.mass_damping_per_s);
  out.set_mass_scaling(in.mass_scaling);
  out.set_rotary_scaling(in.rotary_scaling);
  out.set_rigid_link_slenderness(in.rigid_link_slenderness);
  out.set_fibre_precision(wire_of<v1::Numerics::FibrePrecision>(in.fibre_precision));
  out.set_fidelity(translate::to_proto(in.fidelity));
  out.set_threads(in.threads);
}

}  // namespace

v1::Numerics::Fidelity to_proto(NumericsSpec::Fidelity fidelity) {
  return wire_of<v1::Numerics::Fidelity>(fidelity, NumericsSpec::Fidelity::draft);
}

v1::Case to_case(const SceneSpec& spec) {
  v1::Case out;
  out.set_title(spec.title);
  write_lattice(spec, *out.mutable_lattice());
  if (spec.depth_mm) out.set_depth_mm(*spec.depth_mm);
  if (spec.elements_per_wall) out.set_elements_per_wall(*spec.elements_per_wall);
  write_material(spec.material, *out.mutable_material());
  write_section(spec.section, *out.mutable_section());
  out.mutable_contact()->set_friction(spec.contact.friction);
  out.mutable_contact()->set_stiffness_factor(spec.contact.stiffness_factor);
  out.mutable_contact()->set_damping_ratio(spec.contact.damping_ratio);
  out.mutable_contact()->set_impact_speed_m_per_s(spec.contact.impact_speed_m_per_s);
  out.mutable_contact()->set_search(wire_of<v1::Contact::Search>(spec.contact.search));
  out.mutable_plates()->set_friction(spec.plates.friction);
  const bool has_plates = spec.loading.speed_m_per_s.has_value() || spec.loading.quasi_static;
  if (has_plates || !spec.loading.end_time_s) write_plates(spec.loading, *out.mutable_loading());
  write_loads(spec, out);
  write_numerics(spec.numerics, *out.mutable_numerics());
  out.mutable_output()->set_sample_count(spec.output.sample_count);
  out.mutable_output()->set_frame_count(spec.output.frame_count);
  return out;
}

}  // namespace cellcrush::translate

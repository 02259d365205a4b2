#include "translate/case_to_spec.h"

#include <google/protobuf/descriptor.h>
#include <google/protobuf/message.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "cellcrush/lattice_words.h"
#include "translate/loads_places.h"
#include "translate/materials.h"
#include "translate/network_lists.h"
#include "translate/read_choice.h"

namespace cellcrush::translate {
namespace {

constexpr std::ptrdiff_t kLongestTitle = 200;

// Number of code points in a UTF-8 text: all bytes except continuation bytes.
std::ptrdiff_t character_count(std::string_view text) {
  return std::count_if(text.begin(), text.end(),
                       [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
}

// The message of any lattice of equal cells. Its fields have the names of RegularLattice's members, or are its own.
RegularLattice read_numbers(const google::protobuf::Message& in) {
  RegularLattice out;
  const google::protobuf::Reflection& reflection = *in.GetReflection();
  std::vector<const google::protobuf::FieldDescriptor*> given;
  reflection.ListFields(in, &given);
  for (const auto* field : given) {
    if (field->name() == "columns") {
      out.columns = reflection.GetInt32(in, field);
    } else if (field->name() == "rows") {
      out.rows = reflection.GetInt32(in, field);
    } else if (field->name() == "side_mm") {
      out.side_mm = reflection.GetDouble(in, field);
    } else if (field->name() == "wall_thickness_mm") {
      out.wall_thickness_mm = reflection.GetDouble(in, field);
    } else {
      out.own[std::string(field->name())] = reflection.GetDouble(in, field);
    }
  }
  return out;
}

NetworkWalls read_network(const v1::Lattice::Network& in, Problems& problems) {
  check_compact(in, problems);
  NetworkWalls out = lists_of(in);
  for (int i = 0; i < in.materials_size(); ++i) {
    const std::string path = "lattice.network.materials[" + std::to_string(i) + "].";
    out.materials.push_back(to_spec(in.materials(i), path, problems));
  }
  return out;
}

// Whether the wire's enum ends with `last`, which is number `place` of the spec's values.
template <class Wire, class Out>
constexpr bool ends_alike(Wire greatest, Wire last, Out place, Out first = Out()) {
  return greatest == last && static_cast<int>(last) - 1 == static_cast<int>(place) - static_cast<int>(first);
}
using Precision = NumericsSpec::FibrePrecision;
static_assert(ends_alike(v1::Lattice::Inclusions::Model_MAX, v1::Lattice::Inclusions::MESHED,
                         Inclusions::Model::meshed));
static_assert(ends_alike(v1::Material::Plane_MAX, v1::Material::STRIP, MaterialSpec::Plane::strip));
static_assert(ends_alike(v1::Section::Formulation_MAX, v1::Section::DISPLACEMENT_BASED,
                         SectionSpec::Formulation::displacement_based));
static_assert(ends_alike(v1::Section::DepthRule_MAX, v1::Section::LOBATTO, SectionSpec::DepthRule::lobatto));
static_assert(ends_alike(v1::Section::AreaRule_MAX, v1::Section::CONSTANT_AREA, SectionSpec::AreaRule::constant_area));
static_assert(ends_alike(v1::Contact::Search_MAX, v1::Contact::BUCKETS, ContactSpec::Search::buckets));
static_assert(ends_alike(v1::Loading::Direction_MAX, v1::Loading::Y, LoadingSpec::Direction::y));
static_assert(ends_alike(v1::Loading::Sides::Kind_MAX, v1::Loading::Sides::PERIODIC,
                         LoadingSpec::Sides::Kind::periodic));
static_assert(ends_alike(v1::Loading::Grip::Edge_MAX, v1::Loading::Grip::TOP, LoadsSpec::Grip::Edge::top));
static_assert(ends_alike(v1::Loading::Grip::FixedTo_MAX, v1::Loading::Grip::SUPPORT_PLATE,
                         LoadsSpec::Grip::FixedTo::support_plate));
static_assert(ends_alike(v1::Numerics::FibrePrecision_MAX, v1::Numerics::DOUBLE, Precision::double_precision));
static_assert(ends_alike(v1::Numerics::Fidelity_MAX, v1::Numerics::REFERENCE, NumericsSpec::Fidelity::reference,
                         NumericsSpec::Fidelity::draft));

VoronoiWalls read_voronoi(const v1::Lattice::Voronoi& in) {
  VoronoiWalls out;
  if (in.has_columns()) out.columns = in.columns();
  if (in.has_rows()) out.rows = in.rows();
  if (in.has_side_mm()) out.side_mm = in.side_mm();
  if (in.has_irregularity()) out.irregularity = in.irregularity();
  if (in.has_relaxation_steps()) out.relaxation_steps = in.relaxation_steps();
  if (in.has_seed()) out.seed = in.seed();
  if (in.has_wall_thickness_mm()) out.wall_thickness_mm = in.wall_thickness_mm();
  if (in.has_relative_density()) out.relative_density = in.relative_density();
  if (in.has_edge_walls()) out.edge_walls = in.edge_walls();
  return out;
}

void read_changes(const v1::Lattice& in, LatticeChanges& out, Problems& problems) {
  if (in.defects().has_missing_walls()) out.defects.missing_walls = in.defects().missing_walls();
  if (in.defects().has_thickness_scatter()) out.defects.thickness_scatter = in.defects().thickness_scatter();
  if (in.defects().has_seed()) out.defects.seed = in.defects().seed();
  const v1::Lattice::Grading& grading = in.grading();
  read_choice(grading.axis(), "lattice.grading.axis", out.grading.axis, problems);
  const auto copy = [](const auto& from, std::vector<double>& to) { to.assign(from.begin(), from.end()); };
  copy(grading.thickness_steps(), out.grading.thickness_steps);
  copy(grading.thickness_polynomial(), out.grading.thickness_polynomial);
  copy(grading.size_steps(), out.grading.size_steps);
  copy(grading.size_polynomial(), out.grading.size_polynomial);
  if (in.has_rotation_degrees()) out.rotation_degrees = in.rotation_degrees();
  copy(in.outline().corners_mm(), out.outline.corners_mm);
  if (in.outline().has_edge_wall_thickness_mm()) {
    out.outline.edge_wall_thickness_mm = in.outline().edge_wall_thickness_mm();
  }
}

void read_lattice(const v1::Lattice& in, SceneSpec& spec, Problems& problems) {
  if (in.has_frame()) {
    spec.lattice = to_spec(in.frame(), spec.loads, problems);
  } else if (in.has_network()) {
    spec.lattice = read_network(in.network(), problems);
  } else if (in.has_voronoi()) {
    spec.lattice = read_voronoi(in.voronoi());
  } else if (auto regular = read_regular(in)) {
    spec.lattice = *std::move(regular);
  }
  if (in.imperfection().has_amplitude_mm()) spec.imperfection.amplitude_mm = in.imperfection().amplitude_mm();
  if (in.imperfection().has_bow_mm()) spec.imperfection.bow_mm = in.imperfection().bow_mm();
  if (in.imperfection().has_seed()) spec.imperfection.seed = in.imperfection().seed();
  read_changes(in, spec.changes, problems);
}

void read_inclusions(const v1::Lattice::Inclusions& in, Inclusions& out, Problems& problems) {
  out.rows.assign(in.rows().begin(), in.rows().end());
  if (in.has_thickness_factor()) out.thickness_factor = in.thickness_factor();
  read_choice(in.model(), "lattice.inclusions.model", out.model, problems);
}

void read_section(const v1::Section& in, SectionSpec& out, Problems& problems) {
  if (in.has_axial_points()) out.axial_points = in.axial_points();
  if (in.has_depth_points()) out.depth_points = in.depth_points();
  read_choice(in.formulation(), "section.formulation", out.formulation, problems);
  read_choice(in.depth_rule(), "section.depth_rule", out.depth_rule, problems);
  read_choice(in.area_rule(), "section.area_rule", out.area_rule, problems);
  if (in.has_shear_deformation()) out.shear_deformation = in.shear_deformation();
  if (in.has_shear_factor()) out.shear_factor = in.shear_factor();
  if (in.has_rigid_joints()) out.rigid_joints = in.rigid_joints();
  if (in.has_coupled_bending()) out.coupled_bending = in.coupled_bending();
}

void read_contact(const v1::Case& in, SceneSpec& spec, Problems& problems) {
  if (in.contact().has_friction()) spec.contact.friction = in.contact().friction();
  if (in.contact().has_stiffness_factor()) spec.contact.stiffness_factor = in.contact().stiffness_factor();
  if (in.contact().has_impact_speed_m_per_s()) spec.contact.impact_speed_m_per_s = in.contact().impact_speed_m_per_s();
  if (in.contact().has_damping_ratio()) spec.contact.damping_ratio = in.contact().damping_ratio();
  read_choice(in.contact().search(), "contact.search", spec.contact.search, problems);
  if (in.plates().has_friction()) spec.plates.friction = in.plates().friction();
}

void read_grips(const v1::Loading& in, LoadsSpec& out, Problems& problems) {
  out.grips = read_gripped_edges(in, problems);
  for (int i = 0; i < in.grips_size(); ++i) {
    const std::string path = "loading.grips[" + std::to_string(i) + "]";
    if (in.grips(i).edge() == v1::Loading::Grip::EDGE_UNSPECIFIED) {
      problems.push_back({path + ".edge", "", "is missing.", "Set it to LEFT, RIGHT, BOTTOM or TOP."});
    }
    read_choice(in.grips(i).edge(), path + ".edge", out.grips[i].edge, problems);
    read_choice(in.grips(i).fixed_to(), path + ".fixed_to", out.grips[i].fixed_to, problems);
  }
}

void read_loading(const v1::Loading& in, SceneSpec& spec, Problems& problems) {
  LoadingSpec& out = spec.loading;
  read_choice(in.direction(), "loading.direction", out.direction, problems);
  if (in.has_speed_m_per_s()) out.speed_m_per_s = in.speed_m_per_s();
  if (in.has_quasi_static()) out.quasi_static = in.quasi_static();
  if (in.has_kinetic_share()) out.kinetic_share = in.kinetic_share();
  if (in.has_end_strain()) out.end_strain = in.end_strain();
  if (in.has_ramp_strain()) out.ramp_strain = in.ramp_strain();
  if (in.has_end_time_s()) out.end_time_s = in.end_time_s();
  if (in.has_end_at_rest()) out.end_at_rest = in.end_at_rest();
  spec.loads.gravity_x_m_per_s2 = in.gravity_x_m_per_s2();
  spec.loads.gravity_y_m_per_s2 = in.gravity_y_m_per_s2();
  spec.loads.velocity_x_m_per_s = in.velocity_x_m_per_s();
  spec.loads.velocity_y_m_per_s = in.velocity_y_m_per_s();
  spec.loads.rigid_walls = read_rigid_walls(in, problems);
  read_choice(in.sides().kind(), "loading.sides.kind", out.sides.kind, problems);
  if (in.sides().has_friction()) out.sides.friction = in.sides().friction();
  if (in.sides().has_fixed_width()) out.sides.fixed_width = in.sides().fixed_width();
  if (in.sides().has_period_mm()) out.sides.period_mm = in.sides().period_mm();
  read_grips(in, spec.loads, problems);
}

void read_numerics(const v1::Numerics& in, NumericsSpec& out, Problems& problems) {
  read_choice(in.fidelity(), "numerics.fidelity", out.fidelity, problems, NumericsSpec::Fidelity::draft);
  read_choice(in.fibre_precision(), "numerics.fibre_precision", out.fibre_precision, problems);
  if (in.has_time_step_s()) out.time_step_s = in.time_step_s();
  if (in.has_mass_scaling()) out.mass_scaling = in.mass_scaling();
  if (in.has_rotary_scaling()) out.rotary_scaling = in.rotary_scaling();
  if (in.has_rigid_link_slenderness()) out.rigid_link_slenderness = in.rigid_link_slenderness();
  if (in.has_mass_damping_per_s()) out.mass_damping_per_s = in.mass_damping_per_s();
  if (in.has_threads()) out.threads = in.threads();
}

}  // namespace

std::optional<RegularLattice> read_regular(const v1::Lattice& in) {
  const google::protobuf::Reflection& reflection = *in.GetReflection();
  const auto* kind = reflection.GetOneofFieldDescriptor(in, in.GetDescriptor()->FindOneofByName("kind"));
  if (kind == nullptr || std::ranges::count(lattice_names(), kind->name()) == 0) return std::nullopt;
  RegularLattice out = read_numbers(reflection.GetMessage(in, kind));
  out.kind = kind->name();
  return out;
}

MaterialSpec to_spec(const v1::Material& given, const std::string& path, Problems& problems) {
  v1::Material in = given;
  if (!in.named().empty() && !is_named_material(in.named())) {
    problems.push_back({path + "named", in.named(), "is no material of the list.",
                        "Name one of " + known_materials() + ", or give its numbers."});
    in.set_named(materials().materials(0).name());  // so that no number is said to be missing besides
  }
  in = with_named(in);
  MaterialSpec out;
  if (in.has_youngs_modulus_mpa()) out.youngs_modulus_mpa = in.youngs_modulus_mpa();
  if (in.has_yield_stress_mpa()) out.yield_stress_mpa = in.yield_stress_mpa();
  for (const LawParameter& parameter : kLawParameters) {
    const auto* field = in.GetDescriptor()->FindFieldByName(parameter.name);
    if (in.GetReflection()->HasField(in, field)) out.*parameter.value = in.GetReflection()->GetDouble(in, field);
  }
  if (in.has_density_kg_per_m3()) out.density_kg_per_m3 = in.density_kg_per_m3();
  read_choice(in.plane(), path + "plane", out.plane, problems);
  if (in.has_poissons_ratio()) out.poissons_ratio = in.poissons_ratio();
  const v1::Material::HardeningTable& curve = in.hardening_table();
  out.hardening_table.plastic_strains.assign(curve.plastic_strains().begin(), curve.plastic_strains().end());
  out.hardening_table.stresses_mpa.assign(curve.stresses_mpa().begin(), curve.stresses_mpa().end());
  read_choice(curve.beyond(), path + "hardening_table.beyond", out.hardening_table.beyond, problems);
  if (!in.has_yield_stress_mpa() && !curve.stresses_mpa().empty()) out.yield_stress_mpa = curve.stresses_mpa(0);
  out.rate_table.rates_per_s.assign(in.rate_table().rates_per_s().begin(), in.rate_table().rates_per_s().end());
  out.rate_table.factors.assign(in.rate_table().factors().begin(), in.rate_table().factors().end());
  return out;
}

CaseReading to_spec(const v1::Case& submitted) {
  CaseReading out;
  v1::Case in = submitted;
  move_to_loading(in, out.problems);
  SceneSpec& spec = out.spec;
  if (character_count(in.title()) > kLongestTitle) {
    out.problems.push_back({"title", std::to_string(character_count(in.title())) + " characters", "is too long.",
                            "Use at most 200 characters."});
  }
  spec.title = in.title();
  read_lattice(in.lattice(), spec, out.problems);
  read_inclusions(in.lattice().inclusions(), spec.inclusions, out.problems);
  if (in.has_depth_mm()) spec.depth_mm = in.depth_mm();
  if (in.has_elements_per_wall()) spec.elements_per_wall = in.elements_per_wall();
  spec.material = to_spec(in.material(), "material.", out.problems);
  read_section(in.section(), spec.section, out.problems);
  read_contact(in, spec, out.problems);
  read_loading(in.loading(), spec, out.problems);
  read_numerics(in.numerics(), spec.numerics, out.problems);
  if (in.output().has_sample_count()) spec.output.sample_count = in.output().sample_count();
  if (in.output().has_frame_count()) spec.output.frame_count = in.output().frame_count();
  name_as_given(submitted, out.problems);
  return out;
}

}  // namespace cellcrush::translate

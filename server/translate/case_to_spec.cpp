#include "translate/case_to_spec.h"

#include <algorithm>
#include <string>
#include <string_view>

#include "translate/problems.h"

namespace cellcrush::translate {
namespace {

constexpr std::ptrdiff_t kLongestTitle = 200;

// Code points of a UTF-8 text: all bytes but continuation bytes.
std::ptrdiff_t character_count(std::string_view text) {
  return std::count_if(text.begin(), text.end(),
                       [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
}

// Squares and triangles are described by the same four fields.
template <class Out, class In>
Out regular_lattice(const In& in) {
  Out out;
  if (in.has_columns()) out.columns = in.columns();
  if (in.has_rows()) out.rows = in.rows();
  if (in.has_side_mm()) out.side_mm = in.side_mm();
  if (in.has_wall_thickness_mm()) out.wall_thickness_mm = in.wall_thickness_mm();
  return out;
}

void read_lattice(const v1::Lattice& in, SceneSpec& spec, Problems& problems) {
  switch (in.kind_case()) {
    case v1::Lattice::kHexagon: {
      auto hexagon = regular_lattice<HexagonLattice>(in.hexagon());
      if (in.hexagon().has_vertical_wall_thickness_mm())
        hexagon.vertical_wall_thickness_mm = in.hexagon().vertical_wall_thickness_mm();
      spec.lattice = hexagon;
      break;
    }
    case v1::Lattice::kSquare: spec.lattice = regular_lattice<SquareLattice>(in.square()); break;
    case v1::Lattice::kTriangle: spec.lattice = regular_lattice<TriangleLattice>(in.triangle()); break;
    case v1::Lattice::kFrame: spec.lattice = to_spec(in.frame(), problems); break;
    case v1::Lattice::KIND_NOT_SET: break;
  }
  if (in.imperfection().has_amplitude_mm()) spec.imperfection.amplitude_mm = in.imperfection().amplitude_mm();
  if (in.imperfection().has_seed()) spec.imperfection.seed = in.imperfection().seed();
  spec.inclusions.rows.assign(in.inclusions().rows().begin(), in.inclusions().rows().end());
  if (in.inclusions().has_thickness_factor()) spec.inclusions.thickness_factor = in.inclusions().thickness_factor();
}

void read_section_and_contact(const v1::Case& in, SceneSpec& spec) {
  if (in.section().has_axial_points()) spec.section.axial_points = in.section().axial_points();
  if (in.section().has_depth_points()) spec.section.depth_points = in.section().depth_points();
  if (in.contact().has_friction()) spec.contact.friction = in.contact().friction();
  if (in.contact().has_stiffness_factor()) spec.contact.stiffness_factor = in.contact().stiffness_factor();
  if (in.contact().has_damping_ratio()) spec.contact.damping_ratio = in.contact().damping_ratio();
  if (in.plates().has_friction()) spec.plates.friction = in.plates().friction();
}

void read_loading(const v1::Loading& in, LoadingSpec& out, Problems& problems) {
  switch (in.direction()) {
    case v1::Loading::DIRECTION_UNSPECIFIED:
    case v1::Loading::X: out.direction = LoadingSpec::Direction::x; break;
    case v1::Loading::Y: out.direction = LoadingSpec::Direction::y; break;
    default:
      problems.push_back(invalid_field("loading.direction", std::to_string(in.direction()),
                                       "is no direction that is known here.", "Use X or Y."));
  }
  if (in.has_speed_m_per_s()) out.speed_m_per_s = in.speed_m_per_s();
  if (in.has_end_strain()) out.end_strain = in.end_strain();
  if (in.has_ramp_strain()) out.ramp_strain = in.ramp_strain();
}

void read_numerics(const v1::Numerics& in, NumericsSpec& out, Problems& problems) {
  using Fidelity = NumericsSpec::Fidelity;
  switch (in.fidelity()) {
    case v1::Numerics::FIDELITY_UNSPECIFIED: out.fidelity = Fidelity::unspecified; break;
    case v1::Numerics::DRAFT: out.fidelity = Fidelity::draft; break;
    case v1::Numerics::STANDARD: out.fidelity = Fidelity::standard; break;
    case v1::Numerics::REFERENCE: out.fidelity = Fidelity::reference; break;
    default:
      problems.push_back(invalid_field("numerics.fidelity", std::to_string(in.fidelity()),
                                       "is no fidelity that is known here.", "Use DRAFT, STANDARD or REFERENCE."));
  }
  if (in.has_time_step_s()) out.time_step_s = in.time_step_s();
  if (in.has_mass_damping_per_s()) out.mass_damping_per_s = in.mass_damping_per_s();
  if (in.has_threads()) out.threads = in.threads();
}

}  // namespace

MaterialSpec to_spec(const v1::Material& in) {
  MaterialSpec out;
  if (in.has_youngs_modulus_mpa()) out.youngs_modulus_mpa = in.youngs_modulus_mpa();
  if (in.has_yield_stress_mpa()) out.yield_stress_mpa = in.yield_stress_mpa();
  if (in.has_hardening_modulus_mpa()) out.hardening_modulus_mpa = in.hardening_modulus_mpa();
  if (in.has_isotropic_fraction()) out.isotropic_fraction = in.isotropic_fraction();
  if (in.has_density_kg_per_m3()) out.density_kg_per_m3 = in.density_kg_per_m3();
  return out;
}

CaseReading to_spec(const v1::Case& in) {
  CaseReading out;
  SceneSpec& spec = out.spec;
  if (character_count(in.title()) > kLongestTitle) {
    out.problems.push_back(invalid_field("title", std::to_string(character_count(in.title())) + " characters",
                                         "is too long.", "Use at most 200 characters."));
  }
  spec.title = in.title();
  read_lattice(in.lattice(), spec, out.problems);
  if (in.has_depth_mm()) spec.depth_mm = in.depth_mm();
  if (in.has_elements_per_wall()) spec.elements_per_wall = in.elements_per_wall();
  spec.material = to_spec(in.material());
  read_section_and_contact(in, spec);
  read_loading(in.loading(), spec.loading, out.problems);
  read_numerics(in.numerics(), spec.numerics, out.problems);
  if (in.output().has_sample_count()) spec.output.sample_count = in.output().sample_count();
  if (in.output().has_frame_count()) spec.output.frame_count = in.output().frame_count();
  return out;
}

}  // namespace cellcrush::translate

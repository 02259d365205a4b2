#include "scene/check_spec.h"

#include <array>
#include <charconv>
#include <cmath>

#include "scene/check_frame.h"
#include "scene/field_checker.h"

namespace cellcrush {
namespace {

constexpr double kMostElements = 2e6;

void check_hexagons(const HexagonLattice& hexagon, int elements_per_wall, FieldChecker& check) {
  const std::string path = "lattice.hexagon.";
  const bool columns = check.in_range(path + "columns", hexagon.columns, {2, 10000}, " cells");
  const bool rows = check.in_range(path + "rows", hexagon.rows, {1, 10000}, " cells");
  const bool side = check.positive(path + "side_mm", hexagon.side_mm, " mm");
  const double thickest = side ? 0.5 * *hexagon.side_mm : 1e12;
  const FieldChecker::Range thickness = {.low = 0.0, .high = thickest, .low_open = true};
  check.in_range(path + "wall_thickness_mm", hexagon.wall_thickness_mm, thickness, " mm (half of side_mm)");
  if (hexagon.vertical_wall_thickness_mm) {
    check.in_range(path + "vertical_wall_thickness_mm", hexagon.vertical_wall_thickness_mm, thickness,
                   " mm (half of side_mm)");
  }
  if (columns && rows) {
    const double elements = 3.0 * *hexagon.columns * *hexagon.rows * elements_per_wall;
    if (elements > kMostElements) {
      check.add(path + "columns", std::to_string(*hexagon.columns),
                "makes about " + to_text(std::round(elements)) + " elements with the rows and elements_per_wall given.",
                "Keep columns x rows x 3 x elements_per_wall at or below " + to_text(kMostElements) + ".");
    }
  }
}

void check_lattice(const SceneSpec& spec, FieldChecker& check) {
  if (const auto* hexagon = std::get_if<HexagonLattice>(&spec.lattice)) {
    check_hexagons(*hexagon, spec.elements_per_wall, check);
  } else if (const auto* frame = std::get_if<FrameLattice>(&spec.lattice)) {
    check_frame(*frame, check);
  } else if (std::holds_alternative<SquareLattice>(spec.lattice)) {
    check.add_unimplemented("lattice.square", "", "square lattices are not built yet.", "Use lattice.hexagon.");
  } else if (std::holds_alternative<TriangleLattice>(spec.lattice)) {
    check.add_unimplemented("lattice.triangle", "", "triangle lattices are not built yet.", "Use lattice.hexagon.");
  } else {
    check.add("lattice", "", "is missing.",
              "Give one of lattice.hexagon, lattice.square, lattice.triangle, lattice.frame.");
  }
  check.in_range("lattice.imperfection.amplitude_mm", spec.imperfection.amplitude_mm, {0.0, 1e12}, " mm");
  if (spec.imperfection.amplitude_mm > 0.0) {
    check.add_unimplemented("lattice.imperfection.amplitude_mm", to_text(spec.imperfection.amplitude_mm),
                            "imperfections are not built yet.", "Leave it out or set it to 0.");
  }
}

void check_material(const MaterialSpec& material, FieldChecker& check) {
  check.positive("material.youngs_modulus_mpa", material.youngs_modulus_mpa, " MPa");
  check.positive("material.yield_stress_mpa", material.yield_stress_mpa, " MPa");
  check.in_range("material.hardening_modulus_mpa", material.hardening_modulus_mpa, {0.0, 1e12}, " MPa");
  check.in_range("material.isotropic_fraction", material.isotropic_fraction, {0.0, 1.0}, "");
  check.positive("material.density_kg_per_m3", material.density_kg_per_m3, " kg/m3");
}

void check_friction(const std::string& field, double friction, FieldChecker& check) {
  if (check.in_range(field, friction, {0.0, 10.0}, "") && friction > 0.0) {
    check.add_unimplemented(field, to_text(friction), "friction is not built yet.", "Leave it out or set it to 0.");
  }
}

void check_loading(const LoadingSpec& loading, FieldChecker& check) {
  check.in_range("loading.speed_m_per_s", loading.speed_m_per_s, {.low = 0.0, .high = 1000.0, .low_open = true},
                 " m/s");
  const bool end = check.in_range("loading.end_strain", loading.end_strain,
                                  {.low = 0.0, .high = 0.95, .low_open = true, .high_open = true}, "");
  const double latest = end ? loading.end_strain : 0.95;
  check.in_range("loading.ramp_strain", loading.ramp_strain, {.low = 0.0, .high = latest, .high_open = true},
                 " (end_strain)");
}

void check_numerics(const NumericsSpec& numerics, FieldChecker& check) {
  check.in_range("numerics.time_step_s", numerics.time_step_s, {0.0, 1.0}, " s (0: chosen)");
  check.in_range("numerics.mass_damping_per_s", numerics.mass_damping_per_s, {0.0, 1e12}, " 1/s");
  if (numerics.fidelity != NumericsSpec::Fidelity::unspecified) {
    check.add_unimplemented("numerics.fidelity", "", "fidelity presets are not built yet.", "Leave it out.");
  }
  if (check.in_range("numerics.threads", std::optional<int>(numerics.threads), {1, 1024}, " threads") &&
      numerics.threads > 1) {
    check.add_unimplemented("numerics.threads", std::to_string(numerics.threads),
                            "more than one thread a job is not built yet.", "Leave it out or set it to 1.");
  }
}

}  // namespace

std::string to_text(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

Problems check_spec(const SceneSpec& spec) {
  FieldChecker check;
  check_lattice(spec, check);
  check.positive("depth_mm", spec.depth_mm, " mm");
  check.in_range("elements_per_wall", std::optional<int>(spec.elements_per_wall), {1, 64}, "");
  check_material(spec.material, check);
  check.in_range("section.axial_points", std::optional<int>(spec.section.axial_points), {1, 5}, "");
  check.in_range("section.depth_points", std::optional<int>(spec.section.depth_points), {2, 10}, "");
  check_friction("contact.friction", spec.contact.friction, check);
  check.in_range("contact.stiffness_factor", spec.contact.stiffness_factor, {.low = 0.0, .high = 1.0, .low_open = true},
                 "");
  check.in_range("contact.damping_ratio", spec.contact.damping_ratio, {0.0, 1.0}, "");
  check_friction("plates.friction", spec.plates.friction, check);
  if (!std::holds_alternative<FrameLattice>(spec.lattice)) {
    check_loading(spec.loading, check);
  }
  check_numerics(spec.numerics, check);
  check.in_range("output.sample_count", std::optional<int>(spec.output.sample_count), {10, 100000}, " samples");
  check.in_range("output.frame_count", std::optional<int>(spec.output.frame_count), {1, 2000}, " frames");
  return check.take();
}

}  // namespace cellcrush

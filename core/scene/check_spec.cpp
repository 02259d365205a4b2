#include "scene/check_spec.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <set>

#include "scene/check_frame.h"
#include "scene/field_checker.h"
#include "scene/mesh_size.h"

namespace cellcrush {
namespace {

/// Checks the fields common to all regular lattices. `walls_per_cell` serves to limit the size of the mesh.
template <class Lattice>
void check_regular(const std::string& path, const Lattice& lattice, int fewest_columns, double walls_per_cell,
                   int elements_per_wall, FieldChecker& check) {
  const bool columns =
      check.in_range(path + "columns", lattice.columns, {static_cast<double>(fewest_columns), 10000}, " cells");
  const bool rows = check.in_range(path + "rows", lattice.rows, {1, 10000}, " cells");
  const bool side = check.positive(path + "side_mm", lattice.side_mm, " mm");
  const double thickest = side ? 0.5 * *lattice.side_mm : 1e12;
  check.in_range(path + "wall_thickness_mm", lattice.wall_thickness_mm, {1e-6, thickest}, " mm (half of side_mm)");
  if (columns && rows) {
    const double elements = count_elements(walls_per_cell, *lattice.columns, *lattice.rows, elements_per_wall);
    if (elements > kMostElements) {
      check.add(path + "columns", std::to_string(*lattice.columns),
                "makes about " + to_text(std::round(elements)) + " elements with the rows and elements_per_wall given.",
                "Keep columns x rows x " + to_text(walls_per_cell) + " x elements_per_wall at or below " +
                    to_text(kMostElements) + ".");
    }
  }
}

void check_hexagons(const HexagonLattice& hexagon, const Inclusions& inclusions, int elements_per_wall,
                    FieldChecker& check) {
  const std::string path = "lattice.hexagon.";
  check_regular(path, hexagon, 2, kWallsOfHexagon, elements_per_wall, check);
  const double thickest = hexagon.side_mm && *hexagon.side_mm > 0.0 ? 0.5 * *hexagon.side_mm : 1e12;
  if (hexagon.vertical_wall_thickness_mm) {
    check.in_range(path + "vertical_wall_thickness_mm", hexagon.vertical_wall_thickness_mm, {1e-6, thickest},
                   " mm (half of side_mm)");
  }
  if (inclusions.rows.empty()) {
    return;
  }
  for (std::size_t i = 0; i < inclusions.rows.size(); ++i) {
    check.in_range("lattice.inclusions.rows[" + std::to_string(i) + "]", std::optional<int>(inclusions.rows[i]),
                   {1.0, static_cast<double>(hexagon.rows.value_or(10000))}, " (a row of cells, from the bottom)");
  }
  const std::set<int> stiff(inclusions.rows.begin(), inclusions.rows.end());
  if (inclusions.model == Inclusions::Model::rigid && hexagon.rows && static_cast<int>(stiff.size()) >= *hexagon.rows) {
    check.add("lattice.inclusions.rows", std::to_string(stiff.size()) + " rows", "leaves no deformable cell.",
              "Remove a row, or set lattice.inclusions.model to MESHED.");
  }
  const double thickness =
      std::max(hexagon.wall_thickness_mm.value_or(0.0), hexagon.vertical_wall_thickness_mm.value_or(0.0));
  if (check.in_range("lattice.inclusions.thickness_factor", inclusions.thickness_factor, {1.0, 1e12}, "") &&
      inclusions.thickness_factor * thickness > thickest) {
    check.add("lattice.inclusions.thickness_factor", to_text(inclusions.thickness_factor),
              "makes the stiff walls thicker than half of side_mm.",
              "Give at most " + to_text(thickest / thickness) + ".");
  }
}

void check_imperfection(const SceneSpec& spec, double side, FieldChecker& check) {
  check.in_range("lattice.imperfection.amplitude_mm", spec.imperfection.amplitude_mm, {0.0, 0.1 * side},
                 " mm (a tenth of side_mm)");
}

void check_lattice(const SceneSpec& spec, FieldChecker& check) {
  const auto side_of = [](const auto& lattice) {
    return lattice.side_mm && *lattice.side_mm > 0.0 ? *lattice.side_mm : 1e12;
  };
  if (const auto* hexagon = std::get_if<HexagonLattice>(&spec.lattice)) {
    check_hexagons(*hexagon, spec.inclusions, *spec.elements_per_wall, check);
    check_imperfection(spec, side_of(*hexagon), check);
    return;
  }
  if (const auto* square = std::get_if<SquareLattice>(&spec.lattice)) {
    check_regular("lattice.square.", *square, 1, kWallsOfSquare, *spec.elements_per_wall, check);
    check_imperfection(spec, side_of(*square), check);
  } else if (const auto* triangle = std::get_if<TriangleLattice>(&spec.lattice)) {
    check_regular("lattice.triangle.", *triangle, 1, kWallsOfTriangle, *spec.elements_per_wall, check);
    check_imperfection(spec, side_of(*triangle), check);
  } else if (const auto* frame = std::get_if<FrameLattice>(&spec.lattice)) {
    check_frame(*frame, *spec.elements_per_wall, check);
    if (spec.imperfection.amplitude_mm != 0.0) {
      check.add("lattice.imperfection.amplitude_mm", to_text(spec.imperfection.amplitude_mm),
                "applies to regular lattices only, not to a frame.", "Remove it, and move the frame's nodes instead.");
    }
  } else {
    check.add("lattice", "", "is missing.",
              "Give one of lattice.hexagon, lattice.square, lattice.triangle, lattice.frame.");
  }
  if (!spec.inclusions.rows.empty()) {
    check.add("lattice.inclusions.rows", std::to_string(spec.inclusions.rows.size()) + " rows",
              "apply to hexagons only.", "Remove them, or use lattice.hexagon.");
  }
}

void check_section(const SectionSpec& section, FieldChecker& check) {
  const bool force_based = section.formulation == SectionSpec::Formulation::force_based;
  check.in_range("section.axial_points", std::optional(section.axial_count()),
                 force_based ? FieldChecker::Range{3, 5} : FieldChecker::Range{1, 5},
                 force_based ? " (force-based; displacement-based: 1 to 5)" : "");
  if (section.depth_rule == SectionSpec::DepthRule::lobatto) {
    check.in_range("section.depth_points", std::optional(section.depth_count()), {2, 10}, "");
  } else if (section.depth_count() != 4 && section.depth_count() != 6) {
    check.add("section.depth_points", std::to_string(section.depth_count()),
              "is not available in the full-moment rule.", "Give 4 or 6, or section.depth_rule LOBATTO with 2 to 10.");
  }
}

void check_loading(const LoadingSpec& loading, FieldChecker& check) {
  check.in_range("loading.speed_m_per_s", loading.speed_m_per_s, {1e-6, 1000.0}, " m/s");
  const bool end =
      check.in_range("loading.end_strain", loading.end_strain, {.low = 1e-4, .high = 0.95, .high_open = true}, "");
  const double latest = end ? loading.end_strain : 0.95;
  check.in_range("loading.ramp_strain", loading.ramp_strain, {.low = 0.0, .high = latest, .high_open = true},
                 " (end_strain)");
}

void check_numerics(const NumericsSpec& numerics, FieldChecker& check) {
  check.in_range("numerics.time_step_s", numerics.time_step_s, {0.0, 1.0}, " s (0: automatic)");
  check.in_range("numerics.mass_damping_per_s", numerics.mass_damping_per_s, {0.0, 1e12}, " 1/s");
  check.in_range("numerics.mass_scaling", numerics.mass_scaling, {1.0, 1e6}, " (1: real masses)");
  check.in_range("numerics.rotary_scaling", numerics.rotary_scaling, {1.0, 1e3}, " (1: real inertias)");
  check.in_range("numerics.threads", std::optional<int>(numerics.threads), {1, 1024}, " threads");
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
  check.in_range("elements_per_wall", spec.elements_per_wall, {1, 64}, "");
  check_material("material.", spec.material, check);
  check_section(spec.section, check);
  check.in_range("contact.friction", spec.contact.friction, {0.0, 10.0}, "");
  check.in_range("contact.stiffness_factor", spec.contact.stiffness_factor, {1e-6, 1.0}, "");
  check.in_range("contact.damping_ratio", spec.contact.damping_ratio, {0.0, 1.0}, "");
  check.in_range("plates.friction", spec.plates.friction, {0.0, 10.0}, "");
  if (!std::holds_alternative<FrameLattice>(spec.lattice)) {
    check_loading(spec.loading, check);
  } else if (spec.loading.speed_m_per_s) {
    check.add("loading.speed_m_per_s", to_text(*spec.loading.speed_m_per_s), "applies to lattices between plates only.",
              "Remove loading; use lattice.frame.loads and motions to load a frame.");
  }
  check_numerics(spec.numerics, check);
  check.in_range("output.sample_count", std::optional<int>(spec.output.sample_count), {10, 100000}, " samples");
  check.in_range("output.frame_count", std::optional<int>(spec.output.frame_count), {1, 2000}, " frames");
  return check.take();
}

}  // namespace cellcrush

#include "scene/check_spec.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <string_view>
#include <vector>

#include "scene/lattices.h"
#include "scene/mesh_part.h"

namespace cellcrush {
namespace {

constexpr double kLargest = 1e12;  // shown as no limit

struct FieldLimits {
  std::string_view path;
  FieldChecker::Range range;
  std::string unit;
};

/// The limits of a field at `path`, which may have indices in brackets.
const FieldLimits& limits_of(std::string path) {
  static const std::vector<FieldLimits> kLimits = {
      // in the order of their paths
#include "scene/field_limits.inc"
  };
  for (std::size_t open = path.find('['); open != std::string::npos; open = path.find('[')) {
    path.erase(open, path.find(']', open) + 1 - open);
  }
  const auto found = std::ranges::lower_bound(kLimits, std::string_view(path), {}, &FieldLimits::path);
  assert(found != kLimits.end() && found->path == path);
  return *found;
}

std::string describe(const FieldChecker::Range& range) {
  return range.high >= kLargest
             ? "of at least " + to_text(range.low)
             : "from " + to_text(range.low) + (range.high_open ? " to below " : " to ") + to_text(range.high);
}

/// What follows a range that ends at half of a side.
std::string half_of(double side) { return std::isfinite(side) ? " mm (half of side_mm)" : " mm"; }

/// Checks the fields common to all regular lattices. Returns the side, mm; an endless one if it is not valid.
double check_regular(const SceneSpec& spec, const RegularLattice& lattice, FieldChecker& check) {
  const std::string path = path_of_lattice(spec);
  const bool columns = check.within_limits(path + "columns", lattice.columns);
  const bool rows = check.within_limits(path + "rows", lattice.rows);
  const bool is_sound = check.within_limits(path + "side_mm", lattice.side_mm);
  const double side = is_sound ? *lattice.side_mm : std::numeric_limits<double>::infinity();
  check.in_range(path + "wall_thickness_mm", lattice.wall_thickness_mm, {1e-6, 0.5 * side}, half_of(side));
  if (columns && rows) {
    const double elements = count_elements(spec);
    if (elements > kMostElements) {
      check.add(path + "columns", std::to_string(*lattice.columns),
                "makes about " + to_text(std::round(elements)) + " elements with the rows and elements_per_wall given.",
                "Keep columns x rows x " + to_text(walls_per_cell_of(spec)) + " x elements_per_wall at or below " +
                    to_text(kMostElements) + ".");
    }
  }
  return side;
}

void check_inclusions(const HexagonLattice& hexagon, const Inclusions& inclusions, double side, FieldChecker& check) {
  for (std::size_t i = 0; i < inclusions.rows.size(); ++i) {
    check.in_range("lattice.inclusions.rows[" + std::to_string(i) + "]", inclusions.rows[i],
                   {1.0, static_cast<double>(hexagon.rows.value_or(10000))}, " (a row of cells, from the bottom)");
  }
  const std::set<int> stiff(inclusions.rows.begin(), inclusions.rows.end());
  if (inclusions.model == Inclusions::Model::rigid && hexagon.rows && static_cast<int>(stiff.size()) >= *hexagon.rows) {
    check.add("lattice.inclusions.rows", std::to_string(stiff.size()) + " rows", "leaves no deformable cell.",
              "Remove a row, or set lattice.inclusions.model to MESHED.");
  }
  const double thickness =
      std::max(hexagon.wall_thickness_mm.value_or(0.0), hexagon.vertical_wall_thickness_mm.value_or(0.0));
  if (check.within_limits("lattice.inclusions.thickness_factor", inclusions.thickness_factor) &&
      inclusions.thickness_factor * thickness > 0.5 * side) {
    check.add("lattice.inclusions.thickness_factor", to_text(inclusions.thickness_factor),
              "makes the stiff walls thicker than half of side_mm.",
              "Give at most " + to_text(0.5 * side / thickness) + ".");
  }
}

void check_lattice(const SceneSpec& spec, FieldChecker& check) {
  const auto* hexagon = std::get_if<HexagonLattice>(&spec.lattice);
  if (const RegularLattice* lattice = regular_lattice_of(spec)) {
    const double side = check_regular(spec, *lattice, check);
    if (hexagon != nullptr && hexagon->vertical_wall_thickness_mm) {
      check.in_range("lattice.hexagon.vertical_wall_thickness_mm", hexagon->vertical_wall_thickness_mm,
                     {1e-6, 0.5 * side}, half_of(side));
    }
    if (hexagon != nullptr && !spec.inclusions.rows.empty()) {
      check_inclusions(*hexagon, spec.inclusions, side, check);
    }
    check.in_range("lattice.imperfection.amplitude_mm", spec.imperfection.amplitude_mm, {0.0, 0.1 * side},
                   std::isfinite(side) ? " mm (a tenth of side_mm)" : " mm");
    check.in_range("lattice.imperfection.bow_mm", spec.imperfection.bow_mm, {0.0, 0.05 * side},
                   std::isfinite(side) ? " mm (a twentieth of side_mm)" : " mm");
    if (spec.imperfection.bow_mm > 0.0 && *spec.elements_per_wall == 1) {
      check.add("lattice.imperfection.bow_mm", to_text(spec.imperfection.bow_mm),
                "cannot be shown by one straight element per wall.", "Use an elements_per_wall of at least 2.");
    }
  } else if (std::holds_alternative<FrameLattice>(spec.lattice)) {
    check_frame(spec, check);
    if (spec.imperfection.amplitude_mm != 0.0) {
      check.add("lattice.imperfection.amplitude_mm", to_text(spec.imperfection.amplitude_mm),
                "applies to regular lattices only, not to a frame.", "Remove it, and move the frame's nodes instead.");
    }
    if (spec.imperfection.bow_mm != 0.0) {
      check.add("lattice.imperfection.bow_mm", to_text(spec.imperfection.bow_mm),
                "applies to regular lattices only, not to a frame.", "Remove it, and give bowed beams nodes between.");
    }
  } else {
    check.add("lattice", "", "is missing.",
              "Give one of lattice.hexagon, lattice.square, lattice.triangle, lattice.frame.");
  }
  if (hexagon == nullptr && !spec.inclusions.rows.empty()) {
    check.add("lattice.inclusions.rows", std::to_string(spec.inclusions.rows.size()) + " rows",
              "apply to hexagons only.", "Remove them, or use lattice.hexagon.");
  }
}

void check_section(const SectionSpec& section, FieldChecker& check) {
  const bool force_based = section.formulation == SectionSpec::Formulation::force_based;
  check.in_range("section.axial_points", section.axial_count(),
                 force_based ? FieldChecker::Range{3, 5} : FieldChecker::Range{1, 5},
                 force_based ? " (force-based; displacement-based: 1 to 5)" : "");
  if (section.depth_rule == SectionSpec::DepthRule::lobatto) {
    check.in_range("section.depth_points", section.depth_count(), {2, 10});
  } else if (section.depth_count() != 4 && section.depth_count() != 6) {
    check.add("section.depth_points", std::to_string(section.depth_count()),
              "is not available in the full-moment rule.", "Give 4 or 6, or section.depth_rule LOBATTO with 2 to 10.");
  }
}

void check_loading(const LoadingSpec& loading, FieldChecker& check) {
  check.within_limits("loading.speed_m_per_s", loading.speed_m_per_s);
  const bool end = check.within_limits("loading.end_strain", loading.end_strain);
  const double latest = end ? loading.end_strain : limits_of("loading.end_strain").range.high;
  check.in_range("loading.ramp_strain", loading.ramp_strain, {.low = 0.0, .high = latest, .high_open = true},
                 " (end_strain)");
}

void check_numerics(const NumericsSpec& numerics, FieldChecker& check) {
  check.within_limits("numerics.time_step_s", numerics.time_step_s, " (0: automatic)");
  check.within_limits("numerics.mass_damping_per_s", numerics.mass_damping_per_s);
  check.within_limits("numerics.mass_scaling", numerics.mass_scaling, " (1: real masses)");
  check.within_limits("numerics.rotary_scaling", numerics.rotary_scaling, " (1: real inertias)");
  check.within_limits("numerics.threads", numerics.threads);
}

}  // namespace

std::string to_text(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

bool FieldChecker::in_range(const std::string& field, std::optional<double> value, Range range,
                            const std::string& unit) {
  const char* wrong = nullptr;
  if (!value) {
    wrong = "is missing.";
  } else if (!std::isfinite(*value)) {
    wrong = "is not a finite number.";
  } else if (*value < range.low) {
    wrong = "is too small.";
  } else if (range.high_open ? *value >= range.high : *value > range.high) {
    wrong = "is too large.";
  }
  if (wrong != nullptr) {
    add(field, value ? to_text(*value) : "", wrong, "Give a value " + describe(range) + unit + ".");
  }
  return wrong == nullptr;
}

bool FieldChecker::within_limits(const std::string& field, std::optional<double> value, const std::string& note) {
  const FieldLimits& limits = limits_of(field);
  return in_range(field, value, limits.range, limits.unit + note);
}

void FieldChecker::add(const std::string& field, const std::string& value, const std::string& message,
                       const std::string& remedy) {
  problems_.push_back({field, value, message, remedy});
}

void check_material(const std::string& path, const MaterialSpec& material, FieldChecker& check) {
  check.within_limits(path + "youngs_modulus_mpa", material.youngs_modulus_mpa);
  check.within_limits(path + "yield_stress_mpa", material.yield_stress_mpa);
  check.within_limits(path + "hardening_modulus_mpa", material.hardening_modulus_mpa);
  check.within_limits(path + "isotropic_fraction", material.isotropic_fraction);
  check.within_limits(path + "poissons_ratio", material.poissons_ratio);
  check.within_limits(path + "density_kg_per_m3", material.density_kg_per_m3);
}

double count_elements(const SceneSpec& spec) {
  const int elements_per_wall = *spec.elements_per_wall;
  if (const RegularLattice* lattice = regular_lattice_of(spec)) {
    return walls_per_cell_of(spec) * *lattice->columns * *lattice->rows * elements_per_wall;
  }
  double elements = 0.0;
  for (const FrameLattice::Beam& beam : std::get<FrameLattice>(spec.lattice).beams) {
    elements += std::max(1, beam.elements.value_or(elements_per_wall));
  }
  return elements;
}

Problems check_spec(const SceneSpec& spec) {
  FieldChecker check;
  check_lattice(spec, check);
  check.within_limits("depth_mm", spec.depth_mm);
  check.within_limits("elements_per_wall", spec.elements_per_wall);
  check_material("material.", spec.material, check);
  check_section(spec.section, check);
  check.within_limits("contact.friction", spec.contact.friction);
  check.within_limits("contact.stiffness_factor", spec.contact.stiffness_factor);
  check.within_limits("contact.damping_ratio", spec.contact.damping_ratio);
  check.within_limits("contact.impact_speed_m_per_s", spec.contact.impact_speed_m_per_s, " (0: as the case tells)");
  check.within_limits("plates.friction", spec.plates.friction);
  if (has_plates(spec)) {
    check_loading(spec.loading, check);
  }
  check_numerics(spec.numerics, check);
  check.within_limits("output.sample_count", spec.output.sample_count);
  check.within_limits("output.frame_count", spec.output.frame_count);
  return check.take();
}

}  // namespace cellcrush

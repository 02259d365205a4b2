#include "scene/check_spec.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <string_view>

#include "lattice/lattice.h"

namespace cellcrush {
namespace {

constexpr double kLargest = 1e12;
constexpr double kSmallest = 1e-6;  // far below anything real, far above where squares underflow

std::string describe(const FieldChecker::Range& range) {
  return range.high >= kLargest
             ? "of at least " + to_text(range.low)
             : "from " + to_text(range.low) + (range.high_open ? " to below " : " to ") + to_text(range.high);
}

/// Checks the fields common to all regular lattices. Returns the side, mm; an endless one if it is not valid.
double check_regular(const SceneSpec& spec, const RegularLattice& lattice, FieldChecker& check) {
  const std::string path = path_of_lattice(spec);
  const LatticeKind& kind = *kind_of(spec);
  const bool columns =
      check.in_range(path + "columns", lattice.columns, {static_cast<double>(kind.fewest_columns), 10000}, " cells");
  const bool rows = check.in_range(path + "rows", lattice.rows, {1, 10000}, " cells");
  const bool is_sound = check.positive(path + "side_mm", lattice.side_mm, " mm");
  const double side = is_sound ? *lattice.side_mm : std::numeric_limits<double>::infinity();
  check.in_range(path + "wall_thickness_mm", lattice.wall_thickness_mm, {1e-6, 0.5 * side}, half_of_side(side));
  if (columns && rows) {
    const double elements = count_elements(spec);
    if (elements > kMostElements) {
      check.add(path + "columns", std::to_string(*lattice.columns),
                "makes about " + to_text(std::round(elements)) + " elements with the rows and elements_per_wall given.",
                "Keep columns x rows x " + to_text(kind.walls_per_cell) + " x elements_per_wall at or below " +
                    to_text(kMostElements) + ".");
    }
  }
  return side;
}

void check_imperfection(const SceneSpec& spec, double side, FieldChecker& check) {
  check.in_range("lattice.imperfection.amplitude_mm", spec.imperfection.amplitude_mm, {0.0, 0.1 * side},
                 std::isfinite(side) ? " mm (a tenth of side_mm)" : " mm");
  check.in_range("lattice.imperfection.bow_mm", spec.imperfection.bow_mm, {0.0, 0.05 * side},
                 std::isfinite(side) ? " mm (a twentieth of side_mm)" : " mm");
  if (spec.imperfection.bow_mm > 0.0 && *spec.elements_per_wall == 1) {
    check.add("lattice.imperfection.bow_mm", to_text(spec.imperfection.bow_mm),
              "cannot be shown by one straight element per wall.", "Use an elements_per_wall of at least 2.");
  }
}

void check_no_imperfection(const Imperfection& imperfection, FieldChecker& check) {
  if (imperfection.amplitude_mm != 0.0) {
    check.add("lattice.imperfection.amplitude_mm", to_text(imperfection.amplitude_mm),
              "applies to regular lattices only, not to a frame.", "Remove it, and move the frame's nodes instead.");
  }
  if (imperfection.bow_mm != 0.0) {
    check.add("lattice.imperfection.bow_mm", to_text(imperfection.bow_mm),
              "applies to regular lattices only, not to a frame.", "Remove it, and give bowed beams nodes between.");
  }
}

/// The kinds of which `is_meant` holds, in a sentence: with `before` each.
template <class Predicate>
std::string list_kinds(const char* before, std::string_view LatticeKind::*word, const Predicate& is_meant) {
  std::string list;
  for (const LatticeKind* kind : lattice_kinds()) {
    if (is_meant(*kind)) list += (list.empty() ? "" : ", ") + std::string(before) + std::string(kind->*word);
  }
  return list;
}

void check_lattice(const SceneSpec& spec, FieldChecker& check) {
  const LatticeKind* kind = kind_of(spec);
  if (kind != nullptr) {
    const double side = check_regular(spec, *regular_lattice_of(spec), check);
    if (kind->check != nullptr) kind->check(spec, side, check);
    check_imperfection(spec, side, check);
  } else if (std::holds_alternative<FrameLattice>(spec.lattice)) {
    check_frame(spec, check);
    check_no_imperfection(spec.imperfection, check);
  } else {
    check.add("lattice", "", "is missing.",
              "Give one of " + list_kinds("lattice.", &LatticeKind::name, [](const LatticeKind&) { return true; }) +
                  ", lattice.frame.");
  }
  if ((kind == nullptr || !kind->has_rows_of_cells) && !spec.inclusions.rows.empty()) {
    const auto has_rows = [](const LatticeKind& other) { return other.has_rows_of_cells; };
    check.add("lattice.inclusions.rows", std::to_string(spec.inclusions.rows.size()) + " rows",
              "apply to " + list_kinds("", &LatticeKind::plural, has_rows) + " only.",
              "Remove them, or use " + list_kinds("lattice.", &LatticeKind::name, has_rows) + ".");
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
  check.in_range("loading.speed_m_per_s", loading.speed_m_per_s, {1e-6, 1000.0}, " m/s");
  const bool end =
      check.in_range("loading.end_strain", loading.end_strain, {.low = 1e-4, .high = 0.95, .high_open = true});
  const double latest = end ? loading.end_strain : 0.95;
  check.in_range("loading.ramp_strain", loading.ramp_strain, {.low = 0.0, .high = latest, .high_open = true},
                 " (end_strain)");
}

void check_numerics(const NumericsSpec& numerics, FieldChecker& check) {
  check.in_range("numerics.time_step_s", numerics.time_step_s, {0.0, 1.0}, " s (0: automatic)");
  check.in_range("numerics.mass_damping_per_s", numerics.mass_damping_per_s, {0.0, 1e12}, " 1/s");
  check.in_range("numerics.mass_scaling", numerics.mass_scaling, {1.0, 1e6}, " (1: real masses)");
  check.in_range("numerics.rotary_scaling", numerics.rotary_scaling, {1.0, 1e3}, " (1: real inertias)");
  check.in_range("numerics.threads", numerics.threads, {1, 1024}, " threads");
}

}  // namespace

std::string to_text(double value) {
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value).ptr;
  return {buffer.data(), end};
}

std::string half_of_side(double side) { return std::isfinite(side) ? " mm (half of side_mm)" : " mm"; }

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

bool FieldChecker::positive(const std::string& field, std::optional<double> value, const std::string& unit) {
  return in_range(field, value, {kSmallest, kLargest}, unit);
}

void FieldChecker::add(const std::string& field, const std::string& value, const std::string& message,
                       const std::string& remedy) {
  problems_.push_back({field, value, message, remedy});
}

void check_material(const std::string& path, const MaterialSpec& material, FieldChecker& check) {
  check.positive(path + "youngs_modulus_mpa", material.youngs_modulus_mpa, " MPa");
  check.positive(path + "yield_stress_mpa", material.yield_stress_mpa, " MPa");
  check.in_range(path + "hardening_modulus_mpa", material.hardening_modulus_mpa, {0.0, 1e12}, " MPa");
  check.in_range(path + "isotropic_fraction", material.isotropic_fraction, {0.0, 1.0});
  check.in_range(path + "poissons_ratio", material.poissons_ratio, {0.0, 0.5});
  check.positive(path + "density_kg_per_m3", material.density_kg_per_m3, " kg/m3");
}

double count_elements(const SceneSpec& spec) {
  const int elements_per_wall = *spec.elements_per_wall;
  if (const RegularLattice* lattice = regular_lattice_of(spec)) {
    return kind_of(spec)->walls_per_cell * *lattice->columns * *lattice->rows * elements_per_wall;
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
  check.positive("depth_mm", spec.depth_mm, " mm");
  check.in_range("elements_per_wall", spec.elements_per_wall, {1, 64});
  check_material("material.", spec.material, check);
  check_section(spec.section, check);
  check.in_range("contact.friction", spec.contact.friction, {0.0, 10.0});
  check.in_range("contact.stiffness_factor", spec.contact.stiffness_factor, {1e-6, 1.0});
  check.in_range("contact.damping_ratio", spec.contact.damping_ratio, {0.0, 1.0});
  check.in_range("contact.impact_speed_m_per_s", spec.contact.impact_speed_m_per_s, {0.0, 1000.0},
                 " m/s (0: as the case tells)");
  check.in_range("plates.friction", spec.plates.friction, {0.0, 10.0});
  if (!std::holds_alternative<FrameLattice>(spec.lattice)) {
    check_loading(spec.loading, check);
  } else if (spec.loading.speed_m_per_s) {
    check.add("loading.speed_m_per_s", to_text(*spec.loading.speed_m_per_s), "applies to lattices between plates only.",
              "Remove loading; use lattice.frame.loads and motions to load a frame.");
  }
  check_numerics(spec.numerics, check);
  check.in_range("output.sample_count", spec.output.sample_count, {10, 100000}, " samples");
  check.in_range("output.frame_count", spec.output.frame_count, {1, 2000}, " frames");
  return check.take();
}

}  // namespace cellcrush

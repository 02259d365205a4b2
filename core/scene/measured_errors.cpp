#include "scene/measured_errors.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "cellcrush/presets.h"
#include "scene/check_spec.h"
#include "scene/lattices.h"
#include "scene/measured_rows.h"

namespace cellcrush {
namespace {

/// What a spec shares with the preset that was measured: equal up to rounding.
bool is_near(double one, double other) {
  return std::abs(one - other) <= 0.01 * std::max(std::abs(one), std::abs(other));
}

/// Thickness of the walls along y over that of the others.
double vertical_ratio_of(const SceneSpec& spec) {
  const auto* hexagon = std::get_if<HexagonLattice>(&spec.lattice);
  return hexagon != nullptr
             ? hexagon->vertical_wall_thickness_mm.value_or(*hexagon->wall_thickness_mm) / *hexagon->wall_thickness_mm
             : 1.0;
}

/// A preset, or that many of its cells, and the direction of its crush.
struct Specimen {
  std::string_view preset;
  int columns;
  int rows;
  LoadingSpec::Direction direction;

  bool operator==(const Specimen&) const = default;
};

bool is_smaller_than_preset(const Specimen& specimen) { return specimen.columns > 0; }

Specimen specimen_of(const MeasuredRow& row) { return {row.preset, row.columns, row.rows, row.direction}; }

/// Lowest and highest speed at which a specimen was measured.
std::pair<double, double> speeds_of(const Specimen& specimen) {
  std::pair<double, double> range = {HUGE_VAL, 0.0};
  for (const MeasuredRow& row : kMeasuredRows) {
    if (specimen_of(row) != specimen) continue;
    range = {std::min(range.first, row.speed_m_per_s), std::max(range.second, row.speed_m_per_s)};
  }
  return range;
}

/// Nothing if they are different lattices.
std::optional<std::vector<std::string>> fields_beside(const Specimen& specimen, const SceneSpec& spec) {
  const SceneSpec& measured = find_preset(specimen.preset)->spec;
  if (spec.lattice.index() != measured.lattice.index()) return std::nullopt;
  std::vector<std::string> fields;
  const auto add_if = [&fields](bool differs, const std::string& field) {
    if (differs) fields.push_back(field);
  };
  const std::string lattice = path_of_lattice(spec);
  const RegularLattice& cells = *regular_lattice_of(spec);
  const RegularLattice& its = *regular_lattice_of(measured);
  const bool is_smaller = is_smaller_than_preset(specimen);
  add_if(*cells.columns < (is_smaller ? specimen.columns : *its.columns), lattice + "columns");
  add_if(*cells.rows < (is_smaller ? specimen.rows : *its.rows), lattice + "rows");
  add_if(!is_near(*cells.wall_thickness_mm / *cells.side_mm, *its.wall_thickness_mm / *its.side_mm) ||
             !is_near(vertical_ratio_of(spec), vertical_ratio_of(measured)),
         lattice + "wall_thickness_mm");
  add_if(!spec.inclusions.rows.empty(), "lattice.inclusions");
  const MaterialSpec& material = spec.material;
  add_if(!is_near(*material.youngs_modulus_mpa, *measured.material.youngs_modulus_mpa), "material.youngs_modulus_mpa");
  add_if(!is_near(*material.yield_stress_mpa, *measured.material.yield_stress_mpa), "material.yield_stress_mpa");
  add_if(!is_near(*material.density_kg_per_m3, *measured.material.density_kg_per_m3), "material.density_kg_per_m3");
  add_if(!is_near(material.hardening_modulus_mpa, measured.material.hardening_modulus_mpa),
         "material.hardening_modulus_mpa");
  add_if(spec.loading.direction != specimen.direction, "loading.direction");
  const auto [lowest, highest] = speeds_of(specimen);
  add_if(*spec.loading.speed_m_per_s < lowest || *spec.loading.speed_m_per_s > highest, "loading.speed_m_per_s");
  add_if(spec.contact.friction != measured.contact.friction, "contact.friction");
  add_if(spec.plates.friction != measured.plates.friction, "plates.friction");
  return fields;
}

std::vector<Specimen> measured_specimens() {
  std::vector<Specimen> specimens;
  for (const MeasuredRow& row : kMeasuredRows) {
    if (std::ranges::find(specimens, specimen_of(row)) == specimens.end()) specimens.push_back(specimen_of(row));
  }
  return specimens;
}

/// The rows of one quantity with one mesh whose speeds are next to that of a crush.
std::vector<MeasuredRow> neighbours(const Specimen& specimen, std::string_view quantity, int elements, double speed) {
  std::optional<MeasuredRow> below;
  std::optional<MeasuredRow> above;
  for (const MeasuredRow& row : kMeasuredRows) {
    if (specimen_of(row) != specimen || row.quantity != quantity || row.elements_per_wall != elements) continue;
    if (row.speed_m_per_s <= speed && (!below || row.speed_m_per_s > below->speed_m_per_s)) below = row;
    if (row.speed_m_per_s >= speed && (!above || row.speed_m_per_s < above->speed_m_per_s)) above = row;
  }
  if (!below || !above) return {};
  return below->speed_m_per_s == above->speed_m_per_s ? std::vector{*below} : std::vector{*below, *above};
}

std::string words_of(const std::vector<MeasuredRow>& rows) {
  const Specimen specimen = specimen_of(rows.front());
  std::string words = std::string(rows.front().quantity) + ", ";
  if (is_smaller_than_preset(specimen)) {
    words += std::to_string(specimen.columns) + " x " + std::to_string(specimen.rows) + " cells of ";
  }
  words += specimen.preset;
  if (specimen.direction != find_preset(specimen.preset)->spec.loading.direction) {
    words += specimen.direction == kAlongY ? " along y" : " along x";
  }
  words += ", ";
  if (rows.size() > 1) words += to_text(rows.front().speed_m_per_s) + " to ";
  return words + to_text(rows.back().speed_m_per_s) + " m/s";
}

}  // namespace

std::vector<std::string> fields_beside_measured(const SceneSpec& spec) {
  std::optional<std::vector<std::string>> fewest;
  for (const Specimen& specimen : measured_specimens()) {
    const auto fields = fields_beside(specimen, spec);
    if (fields && (!fewest || fields->size() < fewest->size())) fewest = fields;
  }
  return fewest.value_or(std::vector<std::string>{"lattice"});
}

std::vector<MeasuredError> measured_errors_of(const SceneSpec& spec, int elements_per_wall) {
  std::vector<MeasuredError> errors;
  for (const Specimen& specimen : measured_specimens()) {
    const auto fields = fields_beside(specimen, spec);
    if (!fields || !fields->empty()) continue;
    for (const std::string_view quantity : {"impact plateau", "support plateau", "limit stress"}) {
      const auto rows = neighbours(specimen, quantity, elements_per_wall, *spec.loading.speed_m_per_s);
      if (rows.empty()) continue;
      const auto worst = std::ranges::max_element(
          rows, {}, [](const MeasuredRow& row) { return std::max(row.error, row.uncertainty); });
      errors.push_back({words_of(rows), worst->error, worst->uncertainty, worst->scatter});
    }
  }
  return errors;
}

}  // namespace cellcrush

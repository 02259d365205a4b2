#include "translate/plateau_differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <variant>
#include <vector>

#include "translate/embedded_rows.h"
#include "translate/measured_errors.h"
#include "translate/presets.h"

namespace cellcrush::translate {
namespace {

/// How far the mean of a quantity of one specimen or mesh is from that of another one, at one speed.
struct Difference {
  std::string quantity;
  double speed_m_per_s = 0.0;
  double difference = 0.0;   ///< over the mean of the other one
  double uncertainty = 0.0;  ///< half-width of its 95 % confidence interval
};

/// A row of small_specimens.csv: fewer cells than a preset against the preset, with one mesh.
struct FewerCells : Difference {
  std::string preset;
  int columns = 0;
  int rows = 0;
};

FewerCells read_fewer_cells(Cells& cells) {
  FewerCells row;
  row.preset = cells.text();
  row.quantity = cells.text();
  row.speed_m_per_s = cells.number();
  cells.text();  // elements per wall
  row.columns = cells.count();
  row.rows = cells.count();
  row.difference = cells.number();
  row.uncertainty = cells.number();
  return row;
}

/// A row of default_meshes.csv: the default mesh of a lattice against one twice as fine.
struct CoarserMesh : Difference {
  std::string lattice;    ///< as in the case, or "re-entrant hexagon"
  std::string direction;  ///< x or y
  double relative_density = 0.0;
};

CoarserMesh read_coarser_mesh(Cells& cells) {
  CoarserMesh row;
  row.lattice = cells.text();
  row.direction = cells.text();
  row.quantity = cells.text();
  row.speed_m_per_s = cells.number();
  row.relative_density = cells.number();
  cells.text();  // elements per wall
  row.difference = cells.number();
  row.uncertainty = cells.number();
  return row;
}

std::vector<FewerCells> fewer_cells_of(const std::string& preset) {
  static const std::vector<FewerCells> kAll = rows_of(small_specimens_text(), read_fewer_cells);
  std::vector<FewerCells> found;
  std::ranges::copy_if(kAll, std::back_inserter(found), [&](const FewerCells& row) { return row.preset == preset; });
  return found;
}

std::vector<CoarserMesh> coarser_meshes_of(const std::string& lattice, const std::string& direction) {
  static const std::vector<CoarserMesh> kAll = rows_of(default_meshes_text(), read_coarser_mesh);
  std::vector<CoarserMesh> found;
  std::ranges::copy_if(kAll, std::back_inserter(found),
                       [&](const CoarserMesh& row) { return row.lattice == lattice && row.direction == direction; });
  return found;
}

std::string cells_text(int columns, int rows) { return fmt::format("{} x {} cells", columns, rows); }

/// "impact plateau by up to +38 ± 10 % (50 m/s), support plateau by up to +6 ± 3 % (25 m/s)".
template <class Row>
std::string greatest_text(const std::vector<Row>& rows) {
  std::string text;
  for (const char* quantity : {"impact plateau", "support plateau"}) {
    const Row& greatest = *std::ranges::max_element(
        rows, {}, [&](const Row& row) { return row.quantity == quantity ? std::abs(row.difference) : -1.0; });
    text += fmt::format("{}{} by up to {:+.0f} ± {:.0f} % ({} m/s)", text.empty() ? "" : ", ", quantity,
                        100.0 * greatest.difference, 100.0 * greatest.uncertainty, greatest.speed_m_per_s);
  }
  return text;
}

/// "25 to 200", or "25" if all have it.
template <class Row, class Base>
std::string range_text(const std::vector<Row>& rows, double Base::*number) {
  const auto [least, most] = std::ranges::minmax(rows, {}, number);
  const std::string from = fmt::format("{:.3g}", least.*number);
  const std::string to = fmt::format("{:.3g}", most.*number);
  return from == to ? from : from + " to " + to;
}

bool has_plates(const SceneSpec& spec) { return spec.loading.speed_m_per_s || spec.loading.quasi_static; }

/// As in default_meshes.csv.
std::string name_of_lattice(const SceneSpec& spec) {
  if (const auto* cells = std::get_if<RegularLattice>(&spec.lattice)) {
    const auto angle = cells->own.find("angle_degrees");
    return (angle != cells->own.end() && angle->second < 0.0 ? "re-entrant " : "") + cells->kind;
  }
  return std::holds_alternative<VoronoiWalls>(spec.lattice) ? "voronoi" : "";
}

}  // namespace

std::string describe_small_specimen(const SceneSpec& spec) {
  const auto* cells = std::get_if<RegularLattice>(&spec.lattice);
  if (cells == nullptr || spec.changes != LatticeChanges() || !has_plates(spec)) return {};
  const Preset* largest = largest_measured(cells->kind);
  if (largest == nullptr) return {};
  const auto& whole = std::get<RegularLattice>(largest->spec.lattice);
  if (*cells->columns >= *whole.columns && *cells->rows >= *whole.rows) return {};
  const std::string& name = largest->message.name();
  std::string text =
      fmt::format("Small specimen: {}; the preset {} has {}. ", cells_text(*cells->columns, *cells->rows), name,
                  cells_text(*whole.columns, *whole.rows));
  const std::vector<FewerCells> measured = fewer_cells_of(name);
  if (measured.empty()) {
    return text + "How far the plateaus of fewer cells differ from those of the preset was not measured.";
  }
  text += fmt::format(
      "{} of the latter, crushed along {} at {} m/s, had mean plateaus that differed from those of the whole: {}.",
      cells_text(measured.front().columns, measured.front().rows),
      largest->spec.loading.direction == LoadingSpec::Direction::y ? 'Y' : 'X',
      range_text(measured, &FewerCells::speed_m_per_s), greatest_text(measured));
  if (*cells->columns < measured.front().columns || *cells->rows < measured.front().rows)
    text += " Fewer cells were not measured.";
  return text;
}

std::string describe_default_mesh(const SceneSpec& spec, double relative_density) {
  if (!has_plates(spec) || spec.section.formulation != SectionSpec::Formulation::force_based) return {};
  const bool along_y = spec.loading.direction == LoadingSpec::Direction::y;
  const std::string name = name_of_lattice(spec);
  std::string direction = along_y ? "y" : "x";
  std::vector<CoarserMesh> measured = coarser_meshes_of(name, direction);
  if (measured.empty()) measured = coarser_meshes_of(name, direction = along_y ? "x" : "y");
  if (measured.empty()) return {};
  const double density = std::ranges::min(measured, {}, [&](const CoarserMesh& row) {
                           return std::abs(std::log(row.relative_density / relative_density));
                         }).relative_density;
  std::erase_if(measured, [&](const CoarserMesh& row) { return row.relative_density != density; });
  return fmt::format(
      "Default mesh: such lattices of relative density {:.2g}, crushed along {} at {} m/s, had mean plateaus that "
      "differed from those with twice as many elements per wall: {}.",
      density, direction == "y" ? 'Y' : 'X', range_text(measured, &CoarserMesh::speed_m_per_s),
      greatest_text(measured));
}

}  // namespace cellcrush::translate

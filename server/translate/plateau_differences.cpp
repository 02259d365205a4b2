#include "translate/small_specimen.h"

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

/// A row of small_specimens.csv: the mean of one quantity with fewer cells than a preset, relative to that of the
/// preset, with one mesh and speed.
struct Difference {
  std::string preset;
  std::string quantity;
  double speed_m_per_s = 0.0;
  int columns = 0;
  int rows = 0;
  double difference = 0.0;   ///< over the mean of the preset
  double uncertainty = 0.0;  ///< half-width of its 95 % confidence interval
};

Difference read_difference(Cells& cells) {
  Difference row;
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

std::vector<Difference> differences_of(const std::string& preset) {
  static const std::vector<Difference> kAll = rows_of(small_specimens_text(), read_difference);
  std::vector<Difference> found;
  std::ranges::copy_if(kAll, std::back_inserter(found), [&](const Difference& row) { return row.preset == preset; });
  return found;
}

std::string cells_text(int columns, int rows) { return fmt::format("{} x {} cells", columns, rows); }

/// "impact plateau by up to +38 ± 10 % (50 m/s)".
std::string greatest_text(const std::vector<Difference>& rows, const std::string& quantity) {
  const auto size = [&quantity](const Difference& row) {
    return row.quantity == quantity ? std::abs(row.difference) : -1.0;
  };
  const Difference& greatest = *std::ranges::max_element(rows, {}, size);
  return fmt::format("{} by up to {:+.0f} ± {:.0f} % ({} m/s)", quantity, 100.0 * greatest.difference,
                     100.0 * greatest.uncertainty, greatest.speed_m_per_s);
}

}  // namespace

std::string describe_small_specimen(const SceneSpec& spec) {
  const auto* cells = std::get_if<RegularLattice>(&spec.lattice);
  if (cells == nullptr || spec.changes != LatticeChanges() ||
      !(spec.loading.speed_m_per_s || spec.loading.quasi_static))
    return {};
  const Preset* largest = largest_measured(cells->kind);
  if (largest == nullptr) return {};
  const auto& whole = std::get<RegularLattice>(largest->spec.lattice);
  if (*cells->columns >= *whole.columns && *cells->rows >= *whole.rows) return {};
  const std::string& name = largest->message.name();
  std::string text =
      fmt::format("Small specimen: {}; the preset {} has {}. ", cells_text(*cells->columns, *cells->rows), name,
                  cells_text(*whole.columns, *whole.rows));
  const std::vector<Difference> measured = differences_of(name);
  if (measured.empty()) {
    return text + "How far the plateaus of fewer cells differ from those of the preset was not measured.";
  }
  const auto [slowest, fastest] = std::ranges::minmax(measured, {}, &Difference::speed_m_per_s);
  text += fmt::format(
      "{} of the latter, crushed along {} at {} to {} m/s, had mean plateaus that differed from those of the whole: "
      "{}, "
      "{}.",
      cells_text(measured.front().columns, measured.front().rows),
      largest->spec.loading.direction == LoadingSpec::Direction::y ? 'Y' : 'X', slowest.speed_m_per_s,
      fastest.speed_m_per_s, greatest_text(measured, "impact plateau"), greatest_text(measured, "support plateau"));
  if (*cells->columns < measured.front().columns || *cells->rows < measured.front().rows)
    text += " Fewer cells were not measured.";
  return text;
}

}  // namespace cellcrush::translate

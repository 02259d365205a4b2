#include "terminal/sweep_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "results/field_value.h"
#include "results/sweep_results.h"
#include "terminal/number_text.h"
#include "terminal/summary_text.h"
#include "terminal/table.h"

namespace cellcrush::client {

namespace {

using Align = Table::Align;
using Row = v1::SweepTable::Row;

std::string legend_text(const v1::SweepTable& table, int width) {
  for (const Row& row : table.rows()) {
    const v1::Summary& summary = row.result().summary();
    if (summary.plateau_window_high() <= summary.plateau_window_low()) continue;
    return '\n' +
           wrapped(
               fmt::format("Plateau: mean plate stress from {:.0f} to {:.0f} % strain; up to densif.: at the impact "
                           "plate up to the densification strain. Absorbed energy: work of the impact plate up to "
                           "50 % strain.",
                           100 * summary.plateau_window_low(), 100 * summary.plateau_window_high()),
               width, "", "  ") +
           wrapped(
               "Theory: quasi-static (Gibson-Ashby), shock theory (Eq. 51), shock theory with the jumps measured at "
               "the front (Eq. 52). Crush mode: pattern of the collapsed cells.",
               width, "", "  ");
  }
  return {};
}

// A term of a sum, with its sign separated: " + 0.000231 V^2", " - 0.000231 V^2".
std::string signed_term(double value, const char* factor) {
  return fmt::format(" {} {:.4g} {}", std::signbit(value) ? '-' : '+', std::abs(value), factor);
}

std::string fit_text(const v1::SweepTable& table, int width) {
  const auto all = split_series(table);
  if (!varies_speed_first(table) || table.fields_size() != 1 || all.empty()) return {};
  const auto fit = find_plateau_fit(all.front());
  if (!fit) return {};
  const std::string formula =
      fmt::format("{:.4g}{}{}", fit->constant, signed_term(fit->linear, "V"), signed_term(fit->quadratic, "V^2"));
  std::string text = "\n" + wrapped("plateau stress at the impact plate in MPa, V in m/s", width) +
                     wrapped(fit->passes_through() ? "quadratic through the three points: " + formula
                                                   : "least-squares fit: " + formula + ", largest residual " +
                                                         number_text(fit->largest_residual, 2),
                             width, "  ", "    ");
  if (const auto shock = find_shock_curve(all.front())) {
    text +=
        wrapped(fmt::format("shock theory (Eq. 51): {:.4g}{}", shock->constant, signed_term(shock->quadratic, "V^2")),
                width, "  ", "    ");
  }
  return text;
}

std::string failures_text(const v1::SweepTable& table, int width) {
  std::string text;
  for (const Row& row : table.rows()) {
    const v1::Job& job = row.result();
    if (job.state() != v1::Job::FAILED) continue;
    std::string line = fmt::format("{} FAILED ({})", printable(row.job()), v1::Job::Cause_Name(job.cause()));
    if (!job.cause_message().empty()) line += ": " + printable(job.cause_message());
    text += '\n' + wrapped(line, width, "", "  ");
    if (!job.remedy().empty()) text += wrapped("Remedy: " + printable(job.remedy()), width, "    ", "    ");
  }
  return text;
}

constexpr std::size_t kTableHeadings = 4;

// The heading's lines: name and unit of varied fields, words and unit of results.
void add_headings(Table& table, const v1::SweepTable& results) {
  const std::vector<std::string> fields(results.fields().begin(), results.fields().end());
  std::array<std::vector<std::string>, kTableHeadings> lines;
  const auto add = [&](const std::array<std::string, kTableHeadings>& column) {
    for (std::size_t i = 0; i < kTableHeadings; ++i) lines[i].push_back(column[i]);
  };
  for (const std::string& field : fields) {
    const FieldWords words = words_among(field, fields);
    // One word per line, the last ones together.
    std::array<std::string, kTableHeadings> column;
    std::size_t line = 0;
    for (const std::string& word : wrap_words(words.name, 12)) {
      std::string& place = column[std::min(line++, kTableHeadings - 2)];
      place += (place.empty() ? "" : " ") + word;
    }
    column[kTableHeadings - 1] = words.unit;
    add(column);
  }
  add({"job", "", "", ""});
  add({"state", "", "", ""});
  for (const ResultColumn& column : result_columns()) {
    add({column.heading[0], column.heading[1], column.heading[2], column.unit});
  }
  add({"crush", "mode", "", ""});
  for (auto& line : lines) table.add(std::move(line));
}

}  // namespace

std::string sweep_table_text(const v1::SweepTable& results, const std::string& theory_note, int digits, int width) {
  const auto fields = static_cast<std::size_t>(results.fields_size());
  std::vector<Align> alignment(fields, Align::right);
  alignment.insert(alignment.end(), {Align::left, Align::left});
  alignment.insert(alignment.end(), result_columns().size(), Align::right);
  alignment.push_back(Align::left);
  Table table(alignment, fields + 1);
  add_headings(table, results);
  for (const Row& row : results.rows()) {
    std::vector<std::string> cells;
    for (const double value : row.values()) cells.push_back(value_text(value));
    cells.resize(fields);
    cells.insert(cells.end(), {row.job(), v1::Job::State_Name(row.result().state())});
    for (const ResultColumn& column : result_columns()) {
      const auto value = column.value(row.result().summary());
      cells.push_back(value ? number_text(column.scale * *value, digits) : "-");
    }
    const std::string& mode = row.result().summary().crush_mode_words();
    cells.push_back(mode.empty() ? "-" : mode);
    table.add(std::move(cells));
  }
  std::string constants;
  if (results.rows_size() > 0)
    constants = constants_text(table.remove_constant_columns(fields + 1, kTableHeadings), width);
  std::string text = table.text(0, width) + constants + legend_text(results, width);
  if (!theory_note.empty()) text += '\n' + wrapped("Note: " + printable(theory_note), width);
  return text + fit_text(results, width) + failures_text(results, width);
}

}  // namespace cellcrush::client

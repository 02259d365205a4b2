#include "terminal/sweep_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "results/field_value.h"
#include "results/sweep_results.h"
#include "terminal/number_text.h"
#include "terminal/summary_text.h"
#include "terminal/sweep_text.h"
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
               "the front (Eq. 52). No front: fewer than half of the samples of the plateau have one. Crush mode: "
               "pattern of the collapsed cells.",
               width, "", "  ");
  }
  return {};
}

// A term of a sum, with its sign separated: " + 0.000231 V^2", " - 0.000231 V^2".
std::string signed_term(double value, const char* factor) {
  return fmt::format(" {} {:.4g} {}", std::signbit(value) ? '-' : '+', std::abs(value), factor);
}

// The units of the results, by those of their fields: results in the same unit share one.
std::map<std::string_view, ShownUnit> units_of(const v1::SweepTable& results) {
  std::map<std::string_view, double> largest;
  for (int row = 0; row < results.rows_size(); ++row) {
    for (const ResultColumn& column : result_columns()) {
      double& most = largest[column.unit];
      most = std::max(most, std::abs(result_of(results, row, column).value_or(0.0)));
    }
  }
  std::map<std::string_view, ShownUnit> units;
  for (const ResultColumn& column : result_columns()) {
    units[column.unit] = unit_by_size(column.unit, largest[column.unit]);
  }
  return units;
}

std::string fit_text(const v1::SweepTable& table, int width) {
  const auto all = split_series(table);
  if (!varies_speed_first(table) || table.fields_size() != 1 || all.empty()) return {};
  auto fit = find_plateau_fit(all.front());
  if (!fit) return {};
  const ShownUnit unit = units_of(table).at("MPa");
  *fit = scaled(*fit, unit.factor);
  const std::string formula =
      fmt::format("{:.4g}{}{}", fit->constant, signed_term(fit->linear, "V"), signed_term(fit->quadratic, "V^2"));
  std::string text =
      "\n" + wrapped(fmt::format("plateau stress at the impact plate in {}, V in m/s", unit.name), width) +
      wrapped(fit->passes_through()
                  ? "quadratic through the three points: " + formula
                  : "least-squares fit: " + formula + ", largest residual " + number_text(fit->largest_residual, 2),
              width, "  ", "    ");
  if (const auto shock = find_shock_curve(all.front())) {
    text += wrapped(fmt::format("shock theory (Eq. 51): {:.4g}{}", unit.factor * shock->constant,
                                signed_term(unit.factor * shock->quadratic, "V^2")),
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
void add_headings(Table& table, const v1::SweepTable& results, std::map<std::string_view, ShownUnit>& units) {
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
  if (results.means().empty()) {
    add({"job", "", "", ""});
    add({"state", "", "", ""});
  } else {
    add({"jobs", "", "", ""});
  }
  for (std::size_t i = 0; i < result_columns().size(); ++i) {
    if (i == kColumnsBeforeMode) add({"crush", "mode", "", ""});
    const ResultColumn& column = result_columns()[i];
    add({column.heading[0], column.heading[1], column.heading[2], units[column.unit].name});
  }
  for (auto& line : lines) table.add(std::move(line));
}

// "3.41 ± 0.05", "3.41": the interval with the decimals of the mean, left out if it is below half of the last one.
std::string result_text(double value, std::optional<double> interval, int digits) {
  std::string text = number_text(value, digits);
  if (!interval) return text;
  const std::size_t point = text.find('.');
  if (text.find('e') != std::string::npos) return text + " ± " + number_text(*interval, 1);
  const auto decimals = point == std::string::npos ? 0 : text.size() - point - 1;
  const bool shows = *interval >= 0.5 * std::pow(10.0, -static_cast<double>(decimals));
  return shows ? fmt::format("{} ± {:.{}f}", text, *interval, decimals) : text;
}

// "5", "4 of 5": how many jobs a mean has.
std::string job_count_text(const v1::SweepTable::SeedMeans& means) {
  return means.succeeded_count() == means.job_count()
             ? count_text(means.job_count())
             : fmt::format("{} of {}", means.succeeded_count(), means.job_count());
}

// " (1 of 3)": if a result is the mean of fewer jobs than have succeeded.
std::string fewer_jobs_text(const v1::SweepTable::SeedMeans& means, const ResultColumn& column) {
  const int jobs = find_mean(means, column.path)->job_count();
  return jobs == means.succeeded_count() ? "" : fmt::format(" ({} of {})", jobs, means.succeeded_count());
}

// The rows with warnings, and which: a number that the model may not bear out.
std::string warnings_text(const v1::SweepTable& results, int width) {
  std::string text;
  for (const Row& row : results.rows()) {
    std::set<std::string> kinds;
    for (const v1::Warning& warning : row.result().summary().warnings()) {
      if (warning.kind() != v1::Warning::BORDERS_NEAR) kinds.insert(v1::Warning::Kind_Name(warning.kind()));
    }
    if (kinds.empty()) continue;
    text += wrapped(fmt::format("{}: {}", printable(row.job()), fmt::join(kinds, ", ")), width, "  ", "    ");
  }
  return text.empty() ? text : "\nWith warnings (`cellcrush show` prints them):\n" + text;
}

std::string means_text(const v1::SweepTable& results, int width) {
  if (results.means().empty()) return warnings_text(results, width);
  int failed = 0;
  int warned = 0;
  for (const auto& means : results.means()) {
    failed += means.failed_count();
    warned += means.warned_count();
  }
  std::string text =
      '\n' + wrapped(
                 "Means over the seeds ± the half-width of the 95 % confidence interval (Student's t), of the jobs "
                 "that have succeeded. --each prints one row per job.",
                 width, "", "  ");
  if (failed > 0) text += wrapped(fmt::format("{} FAILED; --each says why.", run_count_text(failed)), width);
  if (warned > 0) {
    text += wrapped(fmt::format("{} with warnings; --each says which.", run_count_text(warned)), width);
  }
  return text;
}

}  // namespace

std::string sweep_table_text(const v1::SweepTable& results, const std::string& theory_note, int digits, int width) {
  const auto fields = static_cast<std::size_t>(results.fields_size());
  const bool has_means = !results.means().empty();
  std::vector<Align> alignment(fields, Align::right);
  alignment.insert(alignment.end(), has_means ? 1 : 2, has_means ? Align::right : Align::left);
  alignment.insert(alignment.end(), kColumnsBeforeMode, Align::right);
  alignment.push_back(Align::left);
  alignment.insert(alignment.end(), result_columns().size() - kColumnsBeforeMode, Align::right);
  Table table(alignment, fields + 1);
  auto units = units_of(results);
  add_headings(table, results, units);
  for (int i = 0; i < results.rows_size(); ++i) {
    const Row& row = results.rows(i);
    const v1::Summary& summary = row.result().summary();
    std::vector<std::string> cells;
    for (const double value : row.values()) cells.push_back(short_text(value));
    cells.resize(fields);
    if (has_means) {
      cells.push_back(job_count_text(results.means(i)));
    } else {
      cells.insert(cells.end(), {row.job(), v1::Job::State_Name(row.result().state())});
    }
    for (std::size_t k = 0; k < result_columns().size(); ++k) {
      const std::string& mode = summary.crush_mode_words();
      if (k == kColumnsBeforeMode) cells.push_back(mode.empty() ? "-" : mode);
      const ResultColumn& column = result_columns()[k];
      const double factor = units[column.unit].factor;
      // That of an error is of no use.
      const bool has_interval = has_means && column.unit != std::string_view("%");
      auto interval = has_interval ? find_interval(results.means(i), column.path) : std::nullopt;
      if (interval) *interval *= factor;
      const auto value = result_of(results, i, column);
      const char* absent = summary.has_plateau_stress_impact_mpa() ? column.absent : "-";
      cells.push_back(value ? result_text(factor * *value, interval, digits) : absent);
      if (value && has_means) cells.back() += fewer_jobs_text(results.means(i), column);
    }
    table.add(std::move(cells));
  }
  std::string constants;
  if (results.rows_size() > 0)
    constants = constants_text(table.remove_constant_columns(fields + 1, kTableHeadings), width);
  std::string text = table.text(0, width) + constants + means_text(results, width) + legend_text(results, width);
  if (!theory_note.empty()) text += '\n' + wrapped("Note: " + printable(theory_note), width);
  return text + fit_text(results, width) + failures_text(results, width);
}

}  // namespace cellcrush::client

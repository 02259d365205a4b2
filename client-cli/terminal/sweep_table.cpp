#include "terminal/sweep_table.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "results/sweep_results.h"
#include "terminal/csv_cell.h"
#include "terminal/number_text.h"
#include "terminal/summary_text.h"
#include "terminal/table.h"

namespace cellcrush::client {

namespace {

using Align = Table::Align;
using Row = v1::SweepTable::Row;

std::string window_text(const v1::SweepTable& table) {
  for (const Row& row : table.rows()) {
    const v1::Summary& summary = row.result().summary();
    if (summary.plateau_window_high() <= summary.plateau_window_low()) continue;
    return fmt::format(
        "plateau: mean stress at the plate from {:.0f} to {:.0f} % strain; to dens.: at the impact plate up to "
        "the densification strain\nabsorbed energy: work of the impact plate up to 50 % strain; front strain: of the "
        "material behind the front\ntheory: Gibson-Ashby (quasi-static), Eq. 51 (shock), Eq. 52 (shock with the jumps "
        "measured at the front); crush mode: where cells collapse\n",
        100 * summary.plateau_window_low(), 100 * summary.plateau_window_high());
  }
  return {};
}

// A term of a sum, its sign set apart: " + 0.000231 V^2", " - 0.000231 V^2".
std::string signed_term(double value, const char* factor) {
  return fmt::format(" {} {:.4g} {}", std::signbit(value) ? '-' : '+', std::abs(value), factor);
}

std::string fit_text(const v1::SweepTable& table) {
  const auto all = split_series(table);
  if (!varies_speed_first(table) || table.fields_size() != 1 || all.empty()) return {};
  const auto fit = find_plateau_fit(all.front());
  if (!fit) return {};
  std::string text = fmt::format("\nplateau at the impact plate in MPa, V in m/s\n  {}{:.4g}{}{}, {}\n",
                                 fit->passes_through() ? "quadratic:         " : "least-squares fit: ", fit->constant,
                                 signed_term(fit->linear, "V"), signed_term(fit->quadratic, "V^2"),
                                 fit->passes_through() ? "through the three points, so that it shows no error"
                                                       : "off by at most " + number_text(fit->largest_residual, 2));
  if (const auto shock = find_shock_curve(all.front())) {
    text += fmt::format("  Eq. 51:            {:.4g}{}\n", shock->constant, signed_term(shock->quadratic, "V^2"));
  }
  return text;
}

std::string failures_text(const v1::SweepTable& table) {
  std::string text;
  for (const Row& row : table.rows()) {
    const v1::Job& job = row.result();
    if (job.state() != v1::FAILED) continue;
    text += fmt::format("\n{} FAILED ({})", printable(row.job()), v1::JobCause_Name(job.cause()));
    if (!job.cause_message().empty()) text += ": " + printable(job.cause_message());
    if (!job.remedy().empty()) text += "\n    Remedy: " + printable(job.remedy());
  }
  return text.empty() ? text : text + '\n';
}

}  // namespace

std::string sweep_table_text(const v1::SweepTable& results) {
  const auto fields = static_cast<std::size_t>(results.fields_size());
  std::vector<Align> alignment(fields, Align::right);
  alignment.insert(alignment.end(), {Align::left, Align::left});
  alignment.insert(alignment.end(), result_columns().size(), Align::right);
  alignment.push_back(Align::left);
  Table table(alignment);
  std::vector<std::string> groups(fields + 2);
  std::vector<std::string> headings(results.fields().begin(), results.fields().end());
  std::vector<std::string> units(fields + 2);
  headings.insert(headings.end(), {"job", "state"});
  for (const ResultColumn& column : result_columns()) {
    groups.emplace_back(column.group);
    headings.emplace_back(column.heading);
    units.emplace_back(column.unit);
  }
  groups.emplace_back("crush");
  headings.emplace_back("mode");
  for (auto* heading : {&groups, &headings, &units}) table.add(std::move(*heading));
  for (const Row& row : results.rows()) {
    std::vector<std::string> cells;
    for (const double value : row.values()) cells.push_back(value_text(value));
    cells.resize(fields);
    cells.insert(cells.end(), {row.job(), v1::JobState_Name(row.result().state())});
    for (const ResultColumn& column : result_columns()) {
      const auto value = column.value(row.result().summary());
      cells.push_back(value ? number_text(column.scale * *value) : "-");
    }
    const std::string mode = crush_mode_text(row.result().summary().crush_mode());
    cells.push_back(mode.empty() ? "-" : mode);
    table.add(std::move(cells));
  }
  std::string text = table.text();
  if (const std::string window = window_text(results); !window.empty()) text += '\n' + window;
  return text + fit_text(results) + failures_text(results);
}

std::string sweep_table_csv(const v1::SweepTable& results) {
  std::string text;
  for (const std::string& field : results.fields()) text += csv_cell(field) + ',';
  text += "job,state";
  for (const ResultColumn& column : result_columns()) text += fmt::format(",{}", column.field);
  text += ",crush_mode\n";
  for (const Row& row : results.rows()) {
    for (int i = 0; i < results.fields_size(); ++i) {
      text += (i < row.values_size() ? value_text(row.values(i)) : std::string()) + ',';
    }
    text += csv_cell(row.job()) + ',' + v1::JobState_Name(row.result().state());
    for (const ResultColumn& column : result_columns()) {
      const auto value = column.value(row.result().summary());
      text += ',' + (value ? fmt::format("{}", *value) : std::string());
    }
    text += ',' + crush_mode_text(row.result().summary().crush_mode()) + '\n';
  }
  return text;
}

}  // namespace cellcrush::client

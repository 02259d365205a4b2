// tests/stability/README.md: the maps of stability.
#include <algorithm>
#include <array>
#include <limits>

#include "bench/csv_table.h"
#include "docs/tables/record_tables.h"

namespace cellcrush::docs {
namespace {

constexpr std::array kLattices = {"hexagon", "square", "triangle"};

std::vector<bench::CsvRow> map_of(const std::string& lattice) {
  return bench::read_csv(kTests + "/stability/stability_map_" + lattice + ".csv");
}

bool is_chosen(const bench::CsvRow& row) { return row.at("chosen") == "1"; }

std::string count_where(const std::string& lattice, const std::string& column, const std::string& value) {
  const auto rows = map_of(lattice);
  return std::to_string(
      std::ranges::count_if(rows, [&](const auto& row) { return !is_chosen(row) && row.at(column) == value; }));
}

std::string outcome_table() {
  PageTable table({"Lattice", "#stable", "#drifting", "#lost", "#WALL_CROSSING", "#CONTACT_ENERGY", "#ENERGY_BALANCE",
                   "#OVERCOMPACTION", "#LARGE_ROTATION"});
  for (const std::string lattice : kLattices) {
    std::vector<std::string> cells = {lattice + "s"};
    for (const char* outcome : {"stable", "drifting", "lost"}) {
      cells.push_back(count_where(lattice, "outcome", outcome));
    }
    for (const char* cause :
         {"wall_crossing", "contact_energy", "energy_balance", "overcompaction", "large_rotation"}) {
      cells.push_back(count_where(lattice, "status", cause));
    }
    table.add_row(cells);
  }
  return table.text();
}

/// How many crushes of a step are stable, of all speeds and stiffnesses.
std::string step_table() {
  std::vector<std::string> heads = {"Stable crushes at dt/dt_crit ="};
  std::vector<double> steps;
  for (const auto& row : map_of(kLattices[0])) {
    const double step = bench::number_in(row, "step");
    if (!is_chosen(row) && std::ranges::find(steps, step) == steps.end()) steps.push_back(step);
  }
  for (const double step : steps) heads.push_back("#" + fixed(step, step > 0.95 ? 2 : 1));
  PageTable table(heads);
  for (const std::string lattice : kLattices) {
    std::vector<std::string> cells = {lattice + "s"};
    const auto rows = map_of(lattice);
    for (const double step : steps) {
      int stable = 0;
      int all = 0;
      for (const auto& row : rows) {
        if (is_chosen(row) || bench::number_in(row, "step") != step) continue;
        ++all;
        stable += row.at("outcome") == "stable" ? 1 : 0;
      }
      cells.push_back(std::to_string(stable) + " of " + std::to_string(all));
    }
    table.add_row(cells);
  }
  return table.text();
}

std::string chosen_table() {
  PageTable table({"Lattice", "V, m/s", "#dt/dt_crit", "#stiffness factor", "outcome", "#energy error"});
  for (const std::string lattice : kLattices) {
    for (const auto& row : map_of(lattice)) {
      if (!is_chosen(row)) continue;
      table.add_row(
          {lattice + "s", row.at("speed_m_per_s"), fixed(bench::number_in(row, "step"), 2),
           fixed(bench::number_in(row, "penalty"), 3), row.at("outcome"),
           percent(std::max(bench::number_in(row, "energy_error"), bench::number_in(row, "contact_energy")), 2)});
    }
  }
  return table.text();
}

}  // namespace

PageTables stability_tables() {
  return {{"outcomes of the maps", outcome_table()},
          {"stable crushes by step", step_table()},
          {"chosen step and stiffness", chosen_table()}};
}

}  // namespace cellcrush::docs

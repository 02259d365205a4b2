#include "load/daemon_costs.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace cellcrush::load {
namespace {

constexpr std::array<std::pair<const char*, double DaemonCosts::*>, 17> kFigures = {{
    {"job_cpu_s", &DaemonCosts::job_cpu_s},
    {"sample_cpu_s", &DaemonCosts::sample_cpu_s},
    {"follow_cpu_s", &DaemonCosts::follow_cpu_s},
    {"watch_cpu_s", &DaemonCosts::watch_cpu_s},
    {"slot_gap_s", &DaemonCosts::slot_gap_s},
    {"commit_s", &DaemonCosts::commit_s},
    {"change_s", &DaemonCosts::change_s},
    {"sample_commit_s", &DaemonCosts::sample_commit_s},
    {"job_journal_bytes", &DaemonCosts::job_journal_bytes},
    {"sample_journal_bytes", &DaemonCosts::sample_journal_bytes},
    {"sample_result_bytes", &DaemonCosts::sample_result_bytes},
    {"job_result_bytes", &DaemonCosts::job_result_bytes},
    {"waiting_journal_bytes", &DaemonCosts::waiting_journal_bytes},
    {"waiting_memory_bytes", &DaemonCosts::waiting_memory_bytes},
    {"small_run_s", &DaemonCosts::small_run_s},
    {"small_run_spread", &DaemonCosts::small_run_spread},
    {"small_samples", &DaemonCosts::small_samples},
}};

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> out;
  std::istringstream row(line);
  for (std::string cell; std::getline(row, cell, ',');) out.push_back(cell);
  return out;
}

}  // namespace

DaemonCosts costs_of(const std::map<std::string, double>& figures) {
  DaemonCosts out;
  for (const auto& [name, member] : kFigures) {
    const auto found = figures.find(name);
    if (found == figures.end())
      throw std::runtime_error(std::string("There is no figure \"") + name + "\". Write the table with cost_load.");
    out.*member = found->second;
  }
  return out;
}

DaemonCosts read_costs(const std::string& file, const std::string& column) {
  std::ifstream table(file);
  std::string line;
  std::getline(table, line);
  const auto names = cells_of(line);
  const auto place = static_cast<std::size_t>(std::find(names.begin(), names.end(), column) - names.begin());
  std::map<std::string, double> figures;
  while (std::getline(table, line)) {
    const auto cells = cells_of(line);
    if (place < cells.size()) figures[cells.front()] = std::stod(cells[place]);
  }
  return costs_of(figures);
}

}  // namespace cellcrush::load

#include "load/daemon_costs.h"

#include <array>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

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

DaemonCosts read_costs(const std::string& file) {
  std::ifstream table(file);
  std::map<std::string, double> medians;
  for (std::string line; std::getline(table, line);) {
    std::istringstream row(line);
    std::string name;
    std::string unit;
    double median = 0.0;
    if (std::getline(row, name, ',') && std::getline(row, unit, ',') && row >> median) medians[name] = median;
  }
  return costs_of(medians);
}

}  // namespace cellcrush::load

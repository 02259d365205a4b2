#include "load/figures.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <fstream>

#include "scenes/evidence.h"
#include "worker/stage_timer.h"

namespace cellcrush::load {

double at_share(std::vector<double>& values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

std::string describe(std::vector<double> seconds) {
  const auto at = [&](double share) { return 1e3 * at_share(seconds, share); };
  return fmt::format("{}: p50 {:.2f} ms, p99 {:.2f} ms, greatest {:.2f} ms", seconds.size(), at(0.5), at(0.99),
                     at(1.0));
}

double processor_time_of(int process) {
  clockid_t clock = 0;
  return clock_getcpuclockid(process, &clock) == 0 ? worker::processor_seconds(clock) : 0.0;
}

double memory_of(int process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/statm");
  double all = 0.0;
  double resident = 0.0;
  file >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE)) / (1024.0 * 1024.0);
}

void Record::add(const std::string& quantity, double value, int decimals) {
  figures_.emplace_back(quantity, fmt::format("{:.{}f}", value, decimals));
  fmt::print("{}: {}\n", quantity, figures_.back().second);
}

void Record::write(const std::filesystem::path& file) const {
  auto rows = scenes::read_evidence(file);
  for (const auto& [quantity, value] : figures_) rows[{program_, quantity}] = value;
  scenes::write_evidence(file, rows);
}

}  // namespace cellcrush::load

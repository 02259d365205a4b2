#include "load/figures.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <ctime>
#include <fstream>

#include "worker/stage_timer.h"

namespace cellcrush::load {

std::string describe(std::vector<double> seconds) {
  std::sort(seconds.begin(), seconds.end());
  const auto at = [&](double share) {
    return 1e3 * seconds[static_cast<std::size_t>(share * static_cast<double>(seconds.size() - 1))];
  };
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

}  // namespace cellcrush::load

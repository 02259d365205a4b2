// Measures what each part of a daemon's work costs, on this machine, for the simulation of its queue. Prints a table in
// CSV: each figure's median, lowest and greatest of some rounds.
// usage: cost_load [ROUNDS]
#include <fmt/core.h>

#include <algorithm>
#include <cstdlib>
#include <exception>

#include "bench/machine.h"
#include "load/cost_rounds.h"

namespace cellcrush::load {
namespace {

constexpr int kJobs = 100;  // of each kind in a round

const char* unit_of(const std::string& figure) {
  if (figure.ends_with("_s")) return "s";
  return figure.ends_with("_bytes") ? "B" : "1";
}

void print(const Rounds& rounds) {
  fmt::print("name,unit,median,lowest,greatest,command,machine\n");
  for (const auto& [name, median] : medians_of(rounds)) {
    const auto& values = rounds.at(name);
    const auto [lowest, greatest] = std::minmax_element(values.begin(), values.end());
    fmt::print("{},{},{:.4g},{:.4g},{:.4g},cost_load {},{}\n", name, unit_of(name), median, *lowest, *greatest,
               values.size(), bench::processor_name());
  }
}

}  // namespace
}  // namespace cellcrush::load

int main(int count, char** words) {
  using namespace cellcrush::load;
  const int rounds = count > 1 ? std::max(1, std::atoi(words[1])) : 3;
  Rounds out;
  try {
    for (int i = 0; i < rounds; ++i) {
      measure_journal(out);
      measure_runs(kJobs, out);
      measure_daemon(out);
    }
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
  print(out);
  return 0;
}

#include "bench/bench_flags.h"

#include <exception>
#include <iostream>
#include <stdexcept>
#include <utility>

namespace cellcrush::bench {
namespace {

/// Reads what Google Benchmark has left; answers whether all was known.
bool read_flags(int count, char** words, Flags& flags) {
  const std::pair<std::string, std::string*> known[] = {
      {"--commit=", &flags.commit}, {"--csv=", &flags.csv}, {"--chart=", &flags.chart}, {"--states=", &flags.states}};
  for (int i = 1; i < count; ++i) {
    const std::string word = words[i];
    bool taken = false;
    for (const auto& [prefix, value] : known) {
      if (word.starts_with(prefix)) {
        *value = word.substr(prefix.size());
        taken = true;
      }
    }
    if (!taken) {
      std::cerr << word
                << ": is no flag; give --commit=NAME, --csv=FILE, --chart=FILE, --states=FOLDER, or Google Benchmark's "
                   "(--help).\n";
      return false;
    }
  }
  return true;
}

}  // namespace

int run_benchmarks(int count, char** words, const std::vector<std::string>& counters,
                   const std::function<void(const Flags&)>& add,
                   const std::function<void(const std::string& file, const std::vector<Measured>&)>& draw) {
  benchmark::Initialize(&count, words);
  Flags flags;
  if (!read_flags(count, words, flags)) return 2;
  try {
    add(flags);
    RememberingReporter reporter;
    if (benchmark::RunSpecifiedBenchmarks(&reporter) == 0) return 2;
    if (!flags.csv.empty()) append_rows(flags.csv, flags.commit, counters, reporter.measured());
    if (!flags.chart.empty()) draw(flags.chart, reporter.measured());
    return reporter.failed() ? 1 : 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}

void draw_nothing(const std::string& file, const std::vector<Measured>&) {
  throw std::invalid_argument("--chart=" + file + ": these benchmarks have no chart; crush_bench draws one.");
}

}  // namespace cellcrush::bench

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/csv_reporter.h"

namespace cellcrush::bench {

/// What the programs of benchmarks take besides Google Benchmark's flags.
struct Flags {
  std::string commit = "unknown";  ///< --commit=NAME, for the rows
  std::string csv;                 ///< --csv=FILE, to which rows are appended
  std::string chart;               ///< --chart=FILE, .svg or .png
  std::string states;              ///< --states=FOLDER, where crushed states are kept
};

/// Reads the flags, lets `add` register benchmarks, runs those that --benchmark_filter names, appends their rows and
/// hands them to `draw` when a chart is asked for. Returns the program's exit code; problems are told on standard
/// error.
int run_benchmarks(int count, char** words, const std::vector<std::string>& counters,
                   const std::function<void(const Flags&)>& add,
                   const std::function<void(const std::string& file, const std::vector<Measured>&)>& draw);

/// `draw` of programs that have no chart: throws std::invalid_argument.
void draw_nothing(const std::string& file, const std::vector<Measured>&);

}  // namespace cellcrush::bench

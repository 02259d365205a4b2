#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace cellcrush::bench {

/// What the programs of benchmarks take besides Google Benchmark's flags.
struct Flags {
  std::string commit = "unknown";  ///< --commit=NAME, for the rows
  std::string csv;                 ///< --csv=FILE, to which rows are appended
  std::string chart;               ///< --chart=FILE, .svg or .png
  std::string states;              ///< --states=FOLDER, where crushed states are kept
};

/// What a benchmark has told.
struct Measured {
  std::string benchmark;
  std::string label;  ///< the kernel
  std::map<std::string, double> counters;
};

/// Reads the flags, lets `add` register benchmarks, runs those that --benchmark_filter names and shows them on the
/// terminal. Appends a row each to the CSV file, below a line of names when that is new: date, commit, processor,
/// benchmark, SIMD target, then the counters; one that a benchmark does not tell is an empty cell. Hands them to `draw`
/// when a chart is asked for. Returns the program's exit code; problems, such as a file with other names, are told on
/// standard error.
int run_benchmarks(int count, char** words, const std::function<void(const Flags&)>& add,
                   const std::function<void(const std::string& file, const std::vector<Measured>&)>& draw);

/// `draw` of programs that have no chart: throws std::invalid_argument.
void draw_nothing(const std::string& file, const std::vector<Measured>&);

}  // namespace cellcrush::bench

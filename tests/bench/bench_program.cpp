#include "bench/bench_program.h"

#include <cstdio>
#include <exception>
#include <fstream>
#include <iostream>
#include <set>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "bench/machine.h"

namespace cellcrush::bench {
namespace {

const std::string kLeading = "date,commit,processor,benchmark,simd_target";

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

/// Shows the benchmarks on the terminal and remembers them.
class RememberingReporter : public benchmark::ConsoleReporter {
 public:
  RememberingReporter() : ConsoleReporter(OO_Tabular) {}

  void ReportRuns(const std::vector<Run>& runs) override {
    for (const Run& run : runs) {
      failed = failed || run.error_occurred;
      if (run.error_occurred || run.run_type == Run::RT_Aggregate) continue;
      Measured& row = measured.emplace_back(Measured{run.run_name.function_name, run.report_label, {}});
      for (const auto& [name, counter] : run.counters) row.counters[name] = counter.value;
    }
    ConsoleReporter::ReportRuns(runs);
  }

  std::vector<Measured> measured;
  bool failed = false;
};

/// The counters of a table in the order of its columns; empty where there is none yet.
std::vector<std::string> columns_of(const std::string& file) {
  std::ifstream stream(file);
  std::string line;
  std::vector<std::string> columns;
  if (!std::getline(stream, line)) return columns;
  if (!line.starts_with(kLeading + ",")) throw std::runtime_error(file + ": is no table of benchmarks; give another.");
  std::istringstream names(line.substr(kLeading.size() + 1));
  for (std::string name; std::getline(names, name, ',');) columns.push_back(name);
  return columns;
}

void append_rows(const std::string& file, const std::string& commit, const std::vector<Measured>& measured) {
  std::set<std::string> told;
  for (const Measured& row : measured) {
    for (const auto& [name, value] : row.counters) told.insert(name);
  }
  std::vector<std::string> columns = columns_of(file);
  const bool is_new = columns.empty();
  if (is_new) columns.assign(told.begin(), told.end());
  if (std::set<std::string>(columns.begin(), columns.end()) != told) {
    throw std::runtime_error(file + ": has other columns than these benchmarks; give another file.");
  }
  std::ofstream stream(file, std::ios::app);
  if (is_new) stream << kLeading;
  for (std::size_t i = 0; is_new && i < columns.size(); ++i) stream << "," << columns[i];
  if (is_new) stream << "\n";
  for (const Measured& row : measured) {
    stream << today() << "," << commit << "," << processor_name() << "," << row.benchmark << "," << row.label;
    for (const std::string& column : columns) {
      char text[32] = "";
      const auto found = row.counters.find(column);
      if (found != row.counters.end()) std::snprintf(text, sizeof(text), "%.5g", found->second);
      stream << "," << text;
    }
    stream << "\n";
  }
  stream.flush();
  if (!stream) throw std::runtime_error(file + ": cannot be written; give a file in a folder that exists.");
}

}  // namespace

int run_benchmarks(int count, char** words, const std::function<void(const Flags&)>& add,
                   const std::function<void(const std::string& file, const std::vector<Measured>&)>& draw) {
  benchmark::Initialize(&count, words);
  Flags flags;
  if (!read_flags(count, words, flags)) return 2;
  try {
    add(flags);
    RememberingReporter reporter;
    if (benchmark::RunSpecifiedBenchmarks(&reporter) == 0) return 2;
    if (!flags.csv.empty()) append_rows(flags.csv, flags.commit, reporter.measured);
    if (!flags.chart.empty()) draw(flags.chart, reporter.measured);
    return reporter.failed ? 1 : 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}

void draw_nothing(const std::string& file, const std::vector<Measured>&) {
  throw std::invalid_argument("--chart=" + file +
                              ": these benchmarks have no chart; solver_bench and crush_bench draw one.");
}

}  // namespace cellcrush::bench

#include "bench/csv_reporter.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "bench/machine.h"

namespace cellcrush::bench {
namespace {

std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.5g", value);
  return text;
}

std::string first_line(const std::string& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

}  // namespace

void RememberingReporter::ReportRuns(const std::vector<Run>& runs) {
  for (const Run& run : runs) {
    failed_ = failed_ || run.error_occurred;
    if (run.error_occurred || run.run_type == Run::RT_Aggregate) continue;
    Measured measured{run.run_name.function_name, run.report_label, {}};
    for (const auto& [name, counter] : run.counters) measured.counters[name] = counter.value;
    measured_.push_back(std::move(measured));
  }
  ConsoleReporter::ReportRuns(runs);
}

void append_rows(const std::string& file, const std::string& commit, const std::vector<std::string>& counters,
                 const std::vector<Measured>& measured) {
  std::string names = "date,commit,processor,benchmark,simd_target";
  for (const std::string& counter : counters) names += "," + counter;
  const bool is_new = !std::filesystem::exists(file) || std::filesystem::is_empty(file);
  if (!is_new && first_line(file) != names) {
    throw std::runtime_error(file + ": has other columns than these benchmarks; give another file.");
  }
  std::ofstream stream(file, std::ios::app);
  if (is_new) stream << names << "\n";
  for (const Measured& row : measured) {
    stream << today() << "," << commit << "," << processor_name() << "," << row.benchmark << "," << row.label;
    for (const std::string& counter : counters) {
      const auto found = row.counters.find(counter);
      stream << "," << (found == row.counters.end() ? "" : text_of(found->second));
    }
    stream << "\n";
  }
  stream.flush();
  if (!stream) throw std::runtime_error(file + ": cannot be written; give a file in a folder that exists.");
}

}  // namespace cellcrush::bench

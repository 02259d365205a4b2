#pragma once

#include <benchmark/benchmark.h>

#include <map>
#include <string>
#include <vector>

namespace cellcrush::bench {

/// What the benchmarks of a run have told, by name, as they ran.
struct Measured {
  std::string benchmark;
  std::string label;  ///< the kernel
  std::map<std::string, double> counters;
};

/// Shows the benchmarks on the terminal and remembers them.
class RememberingReporter : public benchmark::ConsoleReporter {
 public:
  RememberingReporter() : ConsoleReporter(OO_Tabular) {}
  void ReportRuns(const std::vector<Run>& runs) override;

  [[nodiscard]] const std::vector<Measured>& measured() const { return measured_; }
  [[nodiscard]] bool failed() const { return failed_; }

 private:
  std::vector<Measured> measured_;
  bool failed_ = false;
};

/// Appends a row a benchmark to a CSV file, below a line of names when the file is new: date, commit, processor,
/// benchmark, SIMD target, then these counters; one that a benchmark does not tell is an empty cell. Throws
/// std::runtime_error when the file cannot be written, or begins with other names.
void append_rows(const std::string& file, const std::string& commit, const std::vector<std::string>& counters,
                 const std::vector<Measured>& measured);

}  // namespace cellcrush::bench

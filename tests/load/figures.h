#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace cellcrush::load {

using Clock = std::chrono::steady_clock;

inline double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The value below which this share of the values lies. REQUIRES: not empty.
double at_share(std::vector<double>& values, double share);

/// Of some times in seconds: how many, the median, the 99th percentile and the greatest, in ms, as text. REQUIRES: not
/// empty.
std::string describe(std::vector<double> seconds);

/// Processor time that a process has used, s.
double processor_time_of(int process);

/// Resident memory of a process, MiB.
double memory_of(int process);

/// What a program measured, for the table of README.md. A record has rows program,quantity,value (scenes/evidence.h).
class Record {
 public:
  explicit Record(std::string program) : program_(std::move(program)) {}

  /// Prints a figure with so many decimals, and keeps it.
  void add(const std::string& quantity, double value, int decimals);

  /// Replaces these figures of the program in a record.
  void write(const std::filesystem::path& file) const;

 private:
  std::string program_;
  std::vector<std::pair<std::string, std::string>> figures_;
};

}  // namespace cellcrush::load

#pragma once

#include <string>
#include <vector>

namespace cellcrush::load {

/// Of some times in seconds: how many, the median, the 99th percentile and the greatest, in ms, as text. REQUIRES: not
/// empty.
std::string describe(std::vector<double> seconds);

/// Processor time that a process has used, s.
double processor_time_of(int process);

/// Resident memory of a process, MiB.
double memory_of(int process);

}  // namespace cellcrush::load

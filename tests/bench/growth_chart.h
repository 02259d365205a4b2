#pragma once

#include <string>
#include <vector>

#include "bench/csv_reporter.h"

namespace cellcrush::bench {

/// Draws how time and memory grow with the lattice, from the benchmarks named cells/..., to a file .svg or .png. Throws
/// std::invalid_argument on another name or fewer than two such benchmarks, std::runtime_error when it cannot be
/// written.
void draw_growth(const std::string& file, const std::vector<Measured>& measured);

}  // namespace cellcrush::bench

#pragma once

#include <string>
#include <vector>

#include "bench/bench_program.h"

namespace cellcrush::bench {

/// Draws what an element-step costs by the benchmarks of solver_bench on the best kernel, as bars by stage, each beside
/// its ratio to Type I by default at 20 % strain. Throws std::invalid_argument on a file that is neither .svg nor .png,
/// or if that crush was not measured; std::runtime_error when the file cannot be written.
void draw_costs(const std::string& file, const std::vector<Measured>& measured);

}  // namespace cellcrush::bench

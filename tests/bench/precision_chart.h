#pragma once

#include <string>
#include <vector>

#include "bench/precision.h"

namespace cellcrush::bench {

/// Draws time against error, a panel a measure, into a file .svg or .png: a colour or mark a group of variants, bars of the
/// uncertainty, a line along the front, a dashed one where one converged crush scatters. Panels of which the scene has no values
/// are left out. Throws std::invalid_argument as `precisions` does, std::runtime_error when the file cannot be written.
void draw_precisions(const std::string& file, const VariedScene& scene, const std::vector<CsvRow>& rows,
                     const std::string& converged);

}  // namespace cellcrush::bench

#pragma once

#include <string>
#include <vector>

#include "bench/precision.h"

namespace cellcrush::bench {

/// Draws time against error, a panel a measure, into a file .svg or .png: the families of precision_series.h, bars of
/// the 95 % intervals, open marks for bounds, labels that do not cover each other, and the front. Panels of which the
/// scene has no values are left out. Throws std::invalid_argument as `precisions` does, std::runtime_error when the
/// file cannot be written.
void draw_precisions(const std::string& file, const VariedScene& scene, const std::vector<CsvRow>& rows,
                     const std::string& converged);

/// Draws the support plate's plateau alone, 720 units wide and under `title`; only elements a wall are labelled. Throws
/// as draw_precisions does.
void draw_overview(const std::string& file, const VariedScene& scene, const std::vector<CsvRow>& rows,
                   const std::string& converged, const std::string& title);

}  // namespace cellcrush::bench

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "validation/crush_run.h"
#include "validation/options.h"

namespace cellcrush::validation {

/// Cells of a row: names and what stands there.
using Cells = std::vector<std::pair<std::string, std::string>>;

/// Appends a row of what a crush amounts to, behind `leading` cells, below a line of names when the file is new.
/// Stresses MPa, time s; a measure that the run did not reach is an empty cell. Throws std::runtime_error when the file
/// cannot be written.
void append_row(const std::string& file, const Options& options, const CrushRun& run, const Cells& leading = {});

/// The same row, a measure a line, to be read.
std::string describe(const Options& options, const CrushRun& run);

}  // namespace cellcrush::validation

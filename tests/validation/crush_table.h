#pragma once

#include <string>

#include "validation/crush_run.h"
#include "validation/options.h"

namespace cellcrush::validation {

/// Appends a row of what a crush amounts to, below a line of names when the file is new. Stresses MPa, time s; a measure that
/// the run did not reach is an empty cell. Throws std::runtime_error when the file cannot be written.
void append_row(const std::string& file, const Options& options, const CrushRun& run);

/// Writes the curve, a row a sample: strain, the plates' stresses, the energies in N mm.
void write_curve(const std::string& file, const CrushRun& run);

/// The same row, a measure a line, to be read.
std::string describe(const Options& options, const CrushRun& run);

}  // namespace cellcrush::validation

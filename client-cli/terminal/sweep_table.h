#pragma once

#include <string>

#include "cellcrush/v1/sweep.pb.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

inline constexpr int kTableDigits = 3;

/// A sweep's results for a reader: an aligned table, a row a job, results with `digits` significant digits; below it
/// what is the same for all jobs, what the columns mean, whether theory applies to the sweep's `lattice`, the fit of
/// plateau against speed where there is one, and why jobs failed.
std::string sweep_table_text(const v1::SweepTable& table, const v1::Lattice& lattice, int digits = kTableDigits,
                             int width = terminal_width());

/// The same table as CSV with all digits; empty cells where a job has no such figure.
std::string sweep_table_csv(const v1::SweepTable& table);

}  // namespace cellcrush::client

#pragma once

#include <string>

#include "cellcrush/v1/sweep.pb.h"

namespace cellcrush::client {

/// A sweep's results for a reader: an aligned table, a line a job; below it what the columns mean, the fit of plateau
/// against speed where there is one, and why jobs failed.
std::string sweep_table_text(const v1::SweepTable& table);

/// The same rows as CSV, numbers as they read back to the same bits; what is not known is empty.
std::string sweep_table_csv(const v1::SweepTable& table);

}  // namespace cellcrush::client

#pragma once

#include <string>

#include "cellcrush/v1/sweep.pb.h"
#include "columns/csv_text.h"

namespace cellcrush {

/// A shown_table() as CSV with all digits, in the units of the columns' names; a missing result is an empty cell. A
/// mean is followed by the half-width of its 95 % confidence interval and the number of its jobs.
std::string sweep_table_csv(const v1::SweepTable& table, Decimal decimal = Decimal::point);

}  // namespace cellcrush

#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cellcrush/v1/sweep.pb.h"
#include "columns/csv_text.h"

namespace cellcrush::client {

/// A result of a job, as a column of a sweep's table.
struct ResultColumn {
  std::array<const char*, 3> heading;                          ///< its lines, such as "plateau", "impact", "plate"
  const char* unit;                                            ///< the line below them
  const char* field;                                           ///< name with its unit, for CSV
  double scale;                                                ///< from the summary's unit to the heading's
  std::optional<double> (*value)(const v1::Summary& summary);  ///< in the summary's unit
};

/// The columns of a sweep's table, in their order.
const std::vector<ResultColumn>& result_columns();

/// A value of a varied field in the shortest form that reads back exactly: "50", "0.35".
std::string value_text(double value);

/// A sweep's table as CSV with all digits, one line per job; a missing result is an empty cell.
std::string sweep_table_csv(const v1::SweepTable& table, Decimal decimal = Decimal::point);

}  // namespace cellcrush::client

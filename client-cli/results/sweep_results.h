#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cellcrush/v1/sweep.pb.h"
#include "chart/smoothing.h"
#include "columns/result_columns.h"

namespace cellcrush::client {

/// Half-width of the 95 % confidence interval of a mean; nothing if it is unknown or within round-off.
std::optional<double> find_interval(const v1::SweepTable::SeedMeans& means, std::string_view path);

/// Why a theory is missing beside a plateau stress, such as "Eq. 52: no front"; empty if none is.
std::string absent_theory_text(const v1::Summary& summary);

/// Rows of a sweep that differ only in the first varied field, limited to those with a plateau at both plates.
struct ResultSeries {
  std::string name;                           ///< the other fields' values, "wall thickness = 0.3 mm"; may be empty
  std::vector<double> x;                      ///< the first field's values, ascending
  std::vector<const v1::Summary*> summaries;  ///< of the rows in the table, which outlives them
  std::vector<const v1::SweepTable::SeedMeans*> means;  ///< of the rows; empty in a table with one row per job
};

/// A sweep's succeeded jobs as series, in the order of first appearance in the table.
std::vector<ResultSeries> split_series(const v1::SweepTable& table);

/// Whether the first varied field is the speed of the crush.
bool varies_speed_first(const v1::SweepTable& table);

/// The values of a column over a series.
std::vector<double> values_of(const ResultSeries& series, double (*value)(const v1::Summary& summary));

/// The fit of the impact plate's plateau stress in MPa; nothing with fewer than three distinct x.
std::optional<QuadraticFit> find_plateau_fit(const ResultSeries& series);

/// Eq. 51 as a function of speed, from the theory of the series: constant + quadratic V^2. Nothing if no job has it.
/// REQUIRES: x are speeds in m/s.
std::optional<QuadraticFit> find_shock_curve(const ResultSeries& series);

}  // namespace cellcrush::client

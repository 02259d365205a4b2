#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "cellcrush/v1/sweep.pb.h"

namespace cellcrush {

/// The field over which means are taken.
inline constexpr const char* kSeedField = "lattice.imperfection.seed";

/// A result of a job, as a column of a sweep's table.
struct ResultColumn {
  std::array<const char*, 3> heading;  ///< its lines, such as "plateau", "impact", "plate"
  const char* unit;                    ///< of the summary, as in unit_by_size()
  const char* path;                    ///< in Summary
  const char* absent = "-";            ///< instead of a value, beside a plateau

  /// Name with its unit, for CSV: "shock_mpa" of "theory.shock_mpa", "front_shock_mpa" of "front.shock_mpa".
  [[nodiscard]] std::string field() const;
};

/// A number of a summary by its path, such as "front.shock_mpa". Nothing if the run does not have it: a field of theory
/// is 0 where the theory does not apply.
std::optional<double> find_result(const v1::Summary& summary, std::string_view path);

/// The columns of a sweep's table, in their order. The crush mode, which is no number, stands before the one of index
/// kColumnsBeforeMode.
const std::vector<ResultColumn>& result_columns();
inline constexpr std::size_t kColumnsBeforeMode = 11;

/// The table with one row per job; or, unless `each`, with one row for each of its means, if it has any: without the
/// seed among its fields, and with a job that has succeeded if any has, whose summary holds the means. Row and mean
/// have the same index; a table with rows per job has no means.
v1::SweepTable shown_table(const v1::SweepTable& table, bool each);

/// The same for a chart: with one row per job also if it would else vary no field. The seed is the last field.
v1::SweepTable charted_table(const v1::SweepTable& table, bool each);

/// A mean by the path of its result; null if there is none.
const v1::SweepTable::Mean* find_mean(const v1::SweepTable::SeedMeans& means, std::string_view path);

/// The result of a row of a shown_table(), or its mean, in the summary's unit.
std::optional<double> result_of(const v1::SweepTable& table, int row, const ResultColumn& column);

/// "V" of CRUSH_MODE_V; empty if unspecified.
std::string crush_mode_code(v1::Summary::CrushMode mode);

}  // namespace cellcrush

#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/csv_table.h"
#include "cellcrush/convergence.h"

namespace cellcrush::docs {

/// The crushes of one scene and variant of a record, one for each seed that came to its end.
struct CrushGroup {
  std::string scene;
  std::string variant;
  std::string preset;
  double speed = 0.0;  ///< m/s
  int elements_per_wall = 0;
  int default_elements = 0;  ///< per wall
  std::vector<bench::CsvRow> rows;

  [[nodiscard]] SeedStatistics of(const std::string& column) const;
  [[nodiscard]] double greatest(const std::string& column) const;  ///< not a number without any
};

/// The groups of a list (bench::read_variants) in its order, of those that the record has.
std::vector<CrushGroup> read_groups(const std::string& list, const std::string& record);

/// "3.24 ± 0.01": the mean with the standard deviation of one crush. Empty without values.
std::string mean_text(const SeedStatistics& statistics, int decimals);

}  // namespace cellcrush::docs

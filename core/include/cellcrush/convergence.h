#pragma once

#include <span>
#include <vector>

namespace cellcrush {

/// Mean and scatter of one quantity over the seeds of an imperfection.
struct SeedStatistics {
  int count = 0;
  double mean = 0.0;
  double deviation = 0.0;  ///< standard deviation of one value; 0 for a single value

  [[nodiscard]] double variance_of_mean() const { return count > 0 ? deviation * deviation / count : 0.0; }
};
SeedStatistics statistics_of(std::span<const double> values);

/// Half of the 95 % confidence interval of the difference of two means, by Student's distribution. The second may be
/// exact: no values. Infinite if either has a single value.
double interval_of_difference(const SeedStatistics& one, const SeedStatistics& other);

/// One quantity, computed with one mesh.
struct MeshResult {
  int elements_per_wall = 0;
  std::vector<double> values;  ///< one for each seed
};

/// Estimated error of the mean of one mesh. Relative to the mean of the finest mesh.
struct MeshEstimate {
  int elements_per_wall = 0;
  SeedStatistics of_seeds;
  /// |mean - mean of the finest mesh|. For the finest mesh: its difference from the next coarser one. That bounds its
  /// error if halving the elements at least halves the error.
  double error = 0.0;
  double uncertainty = 0.0;  ///< half of the 95 % confidence interval of that difference; a smaller error is noise

  /// The largest error that the interval allows.
  [[nodiscard]] double bound() const { return error + uncertainty; }
};

/// Estimates in the order of the elements per wall, of the meshes that have values. Empty with fewer than two.
std::vector<MeshEstimate> estimate_mesh_errors(std::vector<MeshResult> results);

}  // namespace cellcrush

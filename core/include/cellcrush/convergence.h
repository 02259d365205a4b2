#pragma once

#include <cmath>
#include <optional>
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

/// Mean of a quantity with an infinitely fine mesh, estimated from the means of the finest three meshes. With an
/// observed order of convergence between 1 and 2 (Richardson's extrapolation) it is m + (m - m') / (r^p - 1), where m
/// and m' are the means of the finest and the next mesh, r the ratio of their elements and p the order, which the third
/// mesh gives. An order above 2 counts as 2. Where the order is lower, the means oscillate or the seeds hide the last
/// difference, the limit is m.
struct MeshLimit {
  double value = 0.0;
  std::optional<double> order;  ///< that it was extrapolated with; absent if it is the mean of the finest mesh
  /// Half of the interval by the meshes alone: the grid convergence index. With an observed order it is the step from m
  /// to the limit times 1.25, but at least the step that order 1 would make; otherwise three times the latter. If the
  /// difference of the two coarser meshes, continued with this order, is larger than that of the two finer ones, it
  /// counts instead. P. J. Roache, J. Fluids Eng. 116 (1994) 405-413.
  double mesh_part = 0.0;
  /// Half of the 95 % confidence interval by the scatter between the seeds alone (Student's distribution, Welch's
  /// degrees of freedom). Absent if one of these meshes has a single value.
  std::optional<double> scatter_part;

  /// Half of the interval that holds the limit in at least 95 of 100 sets of seeds, if the error of a mesh falls at
  /// least in proportion to the length of its elements.
  [[nodiscard]] double half_width() const { return std::hypot(mesh_part, scatter_part.value_or(0.0)); }
};

/// Mean of one mesh over the seeds.
struct MeshMean {
  int elements_per_wall = 0;
  SeedStatistics of_seeds;
  double error = 0.0;  ///< |mean - limit| / |limit|
};

/// How far a quantity has converged with the mesh.
struct MeshConvergence {
  MeshLimit limit;
  std::vector<MeshMean> meshes;  ///< in the order of the elements per wall

  /// Half of the limit's interval, relative to the limit. A mesh whose error is smaller may have none.
  [[nodiscard]] double uncertainty() const { return limit.half_width() / std::abs(limit.value); }
};

/// Of the meshes that have values. Nothing with fewer than two.
std::optional<MeshConvergence> estimate_convergence(std::vector<MeshResult> results);

}  // namespace cellcrush

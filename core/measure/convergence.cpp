#include "cellcrush/convergence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace cellcrush {
namespace {

/// Half of a 95 % interval over its standard error, by Student's distribution; beyond ten degrees of freedom by its
/// expansion about the normal distribution, to five digits.
double student_factor(int freedom) {
  constexpr std::array kFactors = {12.7062, 4.30265, 3.18245, 2.77645, 2.57058,
                                   2.44691, 2.36462, 2.30600, 2.26216, 2.22814};
  constexpr double kNormal = 1.959964;
  if (freedom <= static_cast<int>(kFactors.size())) return kFactors[static_cast<std::size_t>(freedom) - 1];
  const double square = kNormal * kNormal;
  return kNormal * (1.0 + (square + 1.0) / (4.0 * freedom) +
                    (5.0 * square * square + 16.0 * square + 3.0) / (96.0 * freedom * freedom));
}

}  // namespace

SeedStatistics statistics_of(std::span<const double> values) {
  SeedStatistics of{static_cast<int>(values.size())};
  if (values.empty()) return of;
  of.mean = std::accumulate(values.begin(), values.end(), 0.0) / of.count;
  double squares = 0.0;
  for (const double value : values) squares += (value - of.mean) * (value - of.mean);
  of.deviation = std::sqrt(squares / std::max(1, of.count - 1));
  return of;
}

double interval_of_difference(const SeedStatistics& one, const SeedStatistics& other) {
  if (one.count == 1 || other.count == 1) return std::numeric_limits<double>::infinity();
  return student_factor(one.count - 1 + std::max(0, other.count - 1)) *
         std::sqrt(one.variance_of_mean() + other.variance_of_mean());
}

std::vector<MeshEstimate> estimate_mesh_errors(std::vector<MeshResult> results) {
  std::erase_if(results, [](const MeshResult& result) { return result.values.empty(); });
  std::ranges::sort(results, {}, &MeshResult::elements_per_wall);
  std::vector<MeshEstimate> estimates;
  if (results.size() < 2) return estimates;
  for (const MeshResult& result : results) {
    estimates.push_back({result.elements_per_wall, statistics_of(result.values)});
  }
  const SeedStatistics finest = estimates.back().of_seeds;
  for (std::size_t i = 0; i < estimates.size(); ++i) {
    const bool is_finest = i + 1 == estimates.size();
    const SeedStatistics& compared = is_finest ? estimates[i - 1].of_seeds : estimates[i].of_seeds;
    estimates[i].error = std::abs((compared.mean - finest.mean) / finest.mean);
    estimates[i].uncertainty = interval_of_difference(compared, finest) / std::abs(finest.mean);
  }
  return estimates;
}

}  // namespace cellcrush

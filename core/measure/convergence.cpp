#include "cellcrush/convergence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace cellcrush {
namespace {

/// Half of a 95 % interval over its standard error, by Student's distribution; beyond ten degrees of freedom by its
/// expansion about the normal distribution, to four digits.
double student_factor(int freedom) {
  constexpr std::array kFactors = {12.7062, 4.30265, 3.18245, 2.77645, 2.57058,
                                   2.44691, 2.36462, 2.30600, 2.26216, 2.22814};
  constexpr double kNormal = 1.959964;
  if (freedom <= static_cast<int>(kFactors.size())) return kFactors[static_cast<std::size_t>(freedom) - 1];
  const double z2 = kNormal * kNormal;
  const double z4 = z2 * z2;
  const double n = freedom;
  return kNormal * (1.0 + (z2 + 1.0) / (4.0 * n) + (5.0 * z4 + 16.0 * z2 + 3.0) / (96.0 * n * n) +
                    (3.0 * z4 * z2 + 19.0 * z4 + 17.0 * z2 - 15.0) / (384.0 * n * n * n));
}

/// Half of the 95 % confidence interval of (1 + share) fine - share coarse, with Welch's degrees of freedom.
double interval_of_extrapolated(const SeedStatistics& coarse, const SeedStatistics& fine, double share) {
  const double of_fine = (1.0 + share) * (1.0 + share) * fine.variance_of_mean();
  const double of_coarse = share * share * coarse.variance_of_mean();
  const double squares =
      of_fine * of_fine / (fine.count - 1) + (share > 0.0 ? of_coarse * of_coarse / (coarse.count - 1) : 0.0);
  if (squares == 0.0) return 0.0;
  const double sum = of_fine + of_coarse;
  return student_factor(static_cast<int>(std::max(1.0, sum * sum / squares))) * std::sqrt(sum);
}

/// Three meshes that an error C / elements^order leaves: the difference of the coarser two means over that of the finer
/// two.
double ratio_of_differences(std::span<const MeshMean, 3> meshes, double order) {
  const double coarser = static_cast<double>(meshes[1].elements_per_wall) / meshes[0].elements_per_wall;
  const double finer = static_cast<double>(meshes[2].elements_per_wall) / meshes[1].elements_per_wall;
  return (std::pow(coarser, order) - 1.0) / (1.0 - std::pow(finer, -order));
}

constexpr double kLeastOrder = 1.0;
constexpr double kGreatestOrder = 2.0;

/// Order of convergence that a ratio of differences shows, at most kGreatestOrder. Nothing if it is below kLeastOrder.
std::optional<double> order_of(std::span<const MeshMean, 3> meshes, double ratio) {
  constexpr double kRoundOff = 1e-9;
  if (!(ratio >= (1.0 - kRoundOff) * ratio_of_differences(meshes, kLeastOrder))) return std::nullopt;
  if (ratio >= ratio_of_differences(meshes, kGreatestOrder)) return kGreatestOrder;
  double low = kLeastOrder;
  double high = kGreatestOrder;
  for (int i = 0; i < 50; ++i) {
    const double middle = std::midpoint(low, high);
    (ratio < ratio_of_differences(meshes, middle) ? high : low) = middle;
  }
  return low;
}

/// REQUIRES: at least two meshes, in the order of their elements.
MeshLimit extrapolate(const std::vector<MeshMean>& meshes) {
  constexpr double kSafetyOfObserved = 1.25;
  constexpr double kSafety = 3.0;
  const SeedStatistics& fine = meshes.back().of_seeds;
  const SeedStatistics& next = meshes[meshes.size() - 2].of_seeds;
  const double difference = fine.mean - next.mean;
  bool scatter_is_known = fine.count > 1 && next.count > 1;
  double coarser_difference = 0.0;
  std::optional<double> order;
  if (meshes.size() > 2) {
    const std::span<const MeshMean, 3> last(&meshes[meshes.size() - 3], 3);
    scatter_is_known = scatter_is_known && last[0].of_seeds.count > 1;
    coarser_difference = next.mean - last[0].of_seeds.mean;
    const double noise = scatter_is_known ? interval_of_difference(fine, next) : 0.0;
    if (std::abs(difference) > noise) order = order_of(last, coarser_difference / difference);
    coarser_difference /= ratio_of_differences(last, order.value_or(kLeastOrder));
  }
  const double refinement =
      static_cast<double>(meshes.back().elements_per_wall) / meshes[meshes.size() - 2].elements_per_wall;
  const auto share_beyond = [refinement](double with_order) { return 1.0 / (std::pow(refinement, with_order) - 1.0); };
  const double share = order ? share_beyond(*order) : 0.0;
  const double of_least_order = share_beyond(kLeastOrder);
  // With an order below the greatest, the two differences are equal.
  const double greatest = std::max(std::abs(difference), std::abs(coarser_difference));
  MeshLimit limit;
  limit.order = order;
  limit.value = fine.mean + share * difference;
  limit.mesh_part = (order ? std::max(kSafetyOfObserved * share, of_least_order) : kSafety * of_least_order) * greatest;
  if (scatter_is_known) limit.scatter_part = interval_of_extrapolated(next, fine, share);
  return limit;
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

std::optional<MeshConvergence> estimate_convergence(std::vector<MeshResult> results) {
  std::erase_if(results, [](const MeshResult& result) { return result.values.empty(); });
  std::ranges::sort(results, {}, &MeshResult::elements_per_wall);
  if (results.size() < 2) return std::nullopt;
  MeshConvergence out;
  for (const MeshResult& result : results) {
    out.meshes.push_back({result.elements_per_wall, statistics_of(result.values)});
  }
  out.limit = extrapolate(out.meshes);
  for (MeshMean& mesh : out.meshes) {
    mesh.error = std::abs((mesh.of_seeds.mean - out.limit.value) / out.limit.value);
  }
  return out;
}

}  // namespace cellcrush

#include "cellcrush/convergence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace cellcrush {
namespace {

TEST(Convergence, OfAFirstOrderMeshIsTheDifferenceFromTheFinest) {
  // mean = 1 + 0.8 / elements, without scatter; the order of the input does not matter.
  const auto mesh = [](int elements) {
    const double value = 1.0 + 0.8 / elements;
    return MeshResult{elements, {value, value, value}};
  };
  const auto estimates = estimate_mesh_errors({mesh(8), mesh(2), mesh(4)});
  ASSERT_EQ(estimates.size(), 3u);
  EXPECT_EQ(estimates[0].elements_per_wall, 2);
  EXPECT_NEAR(estimates[0].error, 0.3 / 1.1, 1e-12);
  EXPECT_NEAR(estimates[1].error, 0.1 / 1.1, 1e-12);
  // The bound of the finest is its distance from the limit here, 0.1, as the order is one.
  EXPECT_NEAR(estimates[2].error * 1.1, 0.1, 1e-12);
  for (const MeshEstimate& estimate : estimates) EXPECT_NEAR(estimate.uncertainty, 0.0, 1e-12);
}

TEST(Convergence, StatisticsAreThoseOfAKnownSample) {
  const std::vector<double> values = {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0};
  const SeedStatistics of = statistics_of(values);
  EXPECT_EQ(of.count, 8);
  EXPECT_DOUBLE_EQ(of.mean, 5.0);
  EXPECT_NEAR(of.deviation, std::sqrt(32.0 / 7.0), 1e-12);
  // Against an exact value: t of 7 degrees of freedom is 2.365.
  EXPECT_NEAR(interval_of_difference(of, {}), 2.365 * std::sqrt(32.0 / 7.0 / 8.0), 5e-3);
}

// Two meshes of the same mean: the interval holds the difference in 95 of 100 trials.
TEST(Convergence, IntervalsHoldTheTrueDifferenceNineteenTimesInTwenty) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(10.0, 0.5);
  int held = 0;
  constexpr int kTrials = 4000;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<MeshResult> results = {{2, {}}, {4, {}}};
    for (MeshResult& result : results) {
      for (int seed = 0; seed < 5; ++seed) result.values.push_back(normal(random));
    }
    const MeshEstimate coarse = estimate_mesh_errors(results).front();
    held += coarse.error <= coarse.uncertainty ? 1 : 0;
  }
  EXPECT_NEAR(held / static_cast<double>(kTrials), 0.95, 0.015);
}

TEST(Convergence, ASingleRunHasNoInterval) {
  const auto estimates = estimate_mesh_errors({{2, {1.0}}, {4, {1.1}}});
  ASSERT_EQ(estimates.size(), 2u);
  EXPECT_NEAR(estimates[0].error, 0.1 / 1.1, 1e-12);
  EXPECT_TRUE(std::isinf(estimates[0].uncertainty));
  EXPECT_TRUE(std::isinf(estimates[0].bound()));
}

TEST(Convergence, OneMeshTellsNothing) {
  EXPECT_TRUE(estimate_mesh_errors({{2, {1.0, 1.1}}, {4, {}}}).empty());
  EXPECT_TRUE(estimate_mesh_errors({}).empty());
}

}  // namespace
}  // namespace cellcrush

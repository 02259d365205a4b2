#include "cellcrush/convergence.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <random>
#include <span>
#include <utility>
#include <vector>

namespace cellcrush {
namespace {

constexpr double kLimit = 10.0;

using Error = std::function<double(int elements)>;

/// Means of meshes with this error about kLimit, a value for each seed, without scatter.
std::vector<MeshResult> meshes_of(const Error& error, std::span<const int> elements, int seeds = 3) {
  std::vector<MeshResult> results;
  for (const int count : elements) {
    results.push_back({count, std::vector<double>(static_cast<std::size_t>(seeds), kLimit + error(count))});
  }
  return results;
}

Error power(double factor, double order) {
  return [=](int elements) { return factor * std::pow(elements, -order); };
}

constexpr std::array kDoubled = {8, 2, 4};  // in any order
constexpr std::array kUneven = {3, 4, 9};

TEST(MeshLimit, OfAnOrderBetweenOneAndTwoIsExactWithItsOrder) {
  for (const double order : {1.0, 1.3, 2.0}) {
    for (const std::span<const int> elements : {std::span<const int>(kDoubled), std::span<const int>(kUneven)}) {
      const auto found = estimate_convergence(meshes_of(power(-4.0, order), elements));
      ASSERT_TRUE(found && found->limit.order) << order;
      EXPECT_NEAR(*found->limit.order, order, 1e-6);
      EXPECT_NEAR(found->limit.value, kLimit, 1e-6);
      const MeshMean& finest = found->meshes.back();
      EXPECT_NEAR(finest.error, std::abs(finest.of_seeds.mean - kLimit) / kLimit, 1e-6);
      EXPECT_GE(found->uncertainty(), 1.2 * finest.error);
      EXPECT_LE(found->uncertainty(), 3.3 * finest.error) << "no wider than its factor of safety";
    }
  }
}

TEST(MeshLimit, OfAHigherOrderIsExtrapolatedWithTwo) {
  const auto found = estimate_convergence(meshes_of(power(4.0, 3.0), kDoubled));
  ASSERT_TRUE(found && found->limit.order);
  EXPECT_EQ(*found->limit.order, 2.0);
  EXPECT_LT(std::abs(found->limit.value - kLimit), found->limit.half_width());
}

TEST(MeshLimit, OfMeansThatOscillateOrSettleSlowlyIsThatOfTheFinestMeshAndInsideTheInterval) {
  const std::vector<Error> errors = {
      [](int elements) { return (elements == 4 ? -1.0 : 1.0) / elements; },
      [](int elements) { return (elements == 4 ? -1.0 : 1.0) / (elements * elements); },
      [](int elements) { return elements == 8 ? 0.1 : 0.0; },
      power(1.0, 0.5),
      power(-1.0, 0.9),
  };
  for (const Error& error : errors) {
    const auto found = estimate_convergence(meshes_of(error, kDoubled));
    ASSERT_TRUE(found);
    EXPECT_FALSE(found->limit.order);
    EXPECT_EQ(found->limit.value, found->meshes.back().of_seeds.mean);
    EXPECT_GE(found->limit.half_width(), std::abs(found->limit.value - kLimit));
  }
}

TEST(MeshLimit, OfTwoMeshesHasTheIntervalOfOrderOneWithAFactorOfThree) {
  const auto found = estimate_convergence({{2, {1.0, 1.0}}, {4, {1.1, 1.1}}});
  ASSERT_TRUE(found);
  EXPECT_EQ(found->limit.value, 1.1);
  EXPECT_NEAR(found->limit.half_width(), 0.3, 1e-12);
}

TEST(MeshLimit, OfSingleRunsHasNoPartOfTheScatter) {
  const auto found = estimate_convergence({{2, {1.0}}, {4, {1.2}}, {8, {1.3}}});
  ASSERT_TRUE(found);
  EXPECT_FALSE(found->limit.scatter_part);
  EXPECT_NEAR(found->limit.value, 1.4, 1e-6);
  EXPECT_NEAR(found->limit.half_width(), 0.125, 1e-6);
}

TEST(MeshLimit, OfOneMeshIsUnknown) {
  EXPECT_FALSE(estimate_convergence({{2, {1.0, 1.1}}, {4, {}}}));
  EXPECT_FALSE(estimate_convergence({}));
}

/// Share of the draws of `seeds` seeds whose interval holds kLimit, and the mean half width over that of the scatter
/// between the seeds of the finest mesh alone.
std::pair<double, double> held_share(const Error& error, int seeds) {
  constexpr int kDraws = 2000;
  constexpr double kScatter = 0.5;
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0.0, kScatter);
  int held = 0;
  double width = 0.0;
  double of_scatter = 0.0;
  for (int draw = 0; draw < kDraws; ++draw) {
    auto results = meshes_of(error, kDoubled, seeds);
    for (MeshResult& result : results) {
      for (double& value : result.values) value += normal(random);
    }
    const MeshConvergence found = *estimate_convergence(results);
    held += std::abs(found.limit.value - kLimit) <= found.limit.half_width() ? 1 : 0;
    width += found.limit.half_width();
    of_scatter += interval_of_difference(found.meshes.back().of_seeds, {});
  }
  return {held / static_cast<double>(kDraws), width / of_scatter};
}

TEST(MeshLimit, OfNoisyMeansIsHeldNineteenTimesInTwenty) {
  for (const int seeds : {3, 5}) {
    for (const double order : {1.0, 1.5, 2.0, 3.0}) {
      // From below the scatter of one run, 0.5, to far above it, with 2 elements.
      for (const double factor : {1.0, 3.0, 10.0, 100.0}) {
        EXPECT_GE(held_share(power(factor, order), seeds).first, 0.93) << seeds << " " << order << " " << factor;
      }
    }
    const auto oscillating = [](int elements) { return (elements == 4 ? -6.0 : 6.0) / elements; };
    EXPECT_GE(held_share(oscillating, seeds).first, 0.95) << seeds;
    const auto [held, width] = held_share([](int) { return 0.0; }, seeds);
    EXPECT_GE(held, 0.95) << seeds;
    EXPECT_LT(width, 3.0) << seeds;
  }
}

TEST(SeedStatistics, AreThoseOfAKnownSample) {
  const std::vector<double> values = {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0};
  const SeedStatistics of = statistics_of(values);
  EXPECT_EQ(of.count, 8);
  EXPECT_DOUBLE_EQ(of.mean, 5.0);
  EXPECT_NEAR(of.deviation, std::sqrt(32.0 / 7.0), 1e-12);
  // Against an exact value: Student's factors of 7, 11, 19 and 99 degrees of freedom, from tables.
  const auto interval = [](int count) { return interval_of_difference({count, 5.0, std::sqrt(count)}, {}); };
  EXPECT_NEAR(interval_of_difference(of, {}), 2.36462 * std::sqrt(32.0 / 7.0 / 8.0), 1e-5);
  EXPECT_NEAR(interval(12), 2.20099, 3e-4);
  EXPECT_NEAR(interval(20), 2.09302, 1e-4);
  EXPECT_NEAR(interval(100), 1.98422, 1e-4);
}

// Two samples of the same mean: the interval holds the difference in 95 of 100 trials.
TEST(SeedStatistics, IntervalsHoldTheTrueDifferenceNineteenTimesInTwenty) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(10.0, 0.5);
  const auto sample = [&] {
    std::array<double, 5> values{};
    for (double& value : values) value = normal(random);
    return statistics_of(values);
  };
  int held = 0;
  constexpr int kTrials = 4000;
  for (int trial = 0; trial < kTrials; ++trial) {
    const SeedStatistics one = sample();
    const SeedStatistics other = sample();
    held += std::abs(one.mean - other.mean) <= interval_of_difference(one, other) ? 1 : 0;
  }
  EXPECT_NEAR(held / static_cast<double>(kTrials), 0.95, 0.015);
}

TEST(SeedStatistics, ASingleValueHasNoInterval) {
  EXPECT_TRUE(std::isinf(interval_of_difference({1, 1.0, 0.0}, {3, 1.0, 0.1})));
}

}  // namespace
}  // namespace cellcrush

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "cellcrush/simulation.h"
#include "measure/curve.h"
#include "scenes/frames.h"
#include "scenes/run_frame.h"

namespace cellcrush {
namespace {

using Stress = std::function<double(double strain)>;

/// Samples of drawn curves of the two plates, each sample the mean over 20 points of its interval.
std::vector<Sample> drawn(const Stress& impact, const Stress& support, double end, int count = 800) {
  constexpr int kPoints = 20;
  std::vector<Sample> samples;
  for (int i = 0; i < count; ++i) {
    Sample sample;
    sample.strain = end * (i + 1) / count;
    for (int k = 0; k < kPoints; ++k) {
      const double strain = end * (i + (k + 0.5) / kPoints) / count;
      sample.stress_impact += impact(strain) / kPoints;
      sample.stress_support += support(strain) / kPoints;
    }
    samples.push_back(sample);
  }
  return samples;
}

std::optional<double> onset_of(std::span<const Sample> samples) {
  return find_densification(curve_of_both_plates(samples));
}

std::optional<double> onset_of(const Stress& both, double end, int count = 800) {
  return onset_of(drawn(both, both, end, count));
}

/// 1 up to `onset`, then rising by 50 a unit of strain: the efficiency is greatest at the onset.
Stress flat_then_steep(double onset) {
  return [onset](double e) { return 1.0 + 50.0 * std::max(0.0, e - onset); };
}

TEST(Densification, IsWhereThePlateauEndsWhateverTheSampling) {
  for (const double onset : {0.45, 0.6, 0.75}) {
    for (const int count : {100, 800, 5000}) {
      const auto found = onset_of(flat_then_steep(onset), onset + 0.05, count);
      ASSERT_TRUE(found) << onset << " " << count;
      EXPECT_NEAR(*found, onset, 0.008) << count;
    }
  }
}

TEST(Densification, OfAHardeningPlateauIsWhereTheEfficiencyIsGreatest) {
  // sigma = 1 + e + 40 (e - 0.5)^3 beyond 0.5, as of foams; its efficiency is greatest where sigma^2 = W sigma'.
  const Stress stress = [](double e) { return 1.0 + e + 40.0 * std::pow(std::max(0.0, e - 0.5), 3.0); };
  double expected = 0.5;
  double work = 0.625;
  const auto slope = [](double e) { return 1.0 + 120.0 * std::pow(e - 0.5, 2.0); };
  for (; stress(expected) * stress(expected) > work * slope(expected); expected += 1e-4)
    work += 1e-4 * stress(expected + 5e-5);
  const auto found = onset_of(stress, 0.9);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, expected, 0.01);
}

TEST(Densification, IsNotTheDipAfterTheFirstWave) {
  const Stress stress = [](double e) {
    if (e < 0.04) return 3.0;
    if (e > 0.05 && e < 0.07) return 0.05;
    if (e > 0.22 && e < 0.235) return 0.1;
    return flat_then_steep(0.7)(e);
  };
  EXPECT_NEAR(onset_of(stress, 0.8).value_or(0.0), 0.7, 0.01);
  EXPECT_FALSE(onset_of(stress, 0.69));
}

TEST(Densification, IsNotTheCollapseOfALayer) {
  // Layers that bear three times the mean and fall to nothing, as squares do.
  const Stress layers = [](double e) { return std::max(0.0, 1.0 + 2.0 * std::sin(2.0 * std::numbers::pi * e / 0.08)); };
  for (double end = 0.35; end < 0.9; end += 0.01) EXPECT_FALSE(onset_of(layers, end)) << end;
  const Stress then_solid = [layers](double e) { return layers(e) + 100.0 * std::max(0.0, e - 0.8); };
  EXPECT_NEAR(onset_of(then_solid, 0.95).value_or(0.0), 0.8, 0.03);
}

TEST(Densification, OfAFastCrushIsWhenTheFrontArrivesAtTheSupport) {
  const Stress impact = [](double e) { return 12.0 + 2.0 * std::sin(80.0 * e) + 300.0 * std::max(0.0, e - 0.88); };
  const Stress support = [](double e) { return e < 0.85 ? 0.4 : 0.4 + 500.0 * (e - 0.85); };
  EXPECT_NEAR(onset_of(drawn(impact, support, 0.92)).value_or(0.0), 0.85, 0.02);
  EXPECT_FALSE(onset_of(drawn(impact, support, 0.84)));
}

TEST(Densification, IsNotReachedByAPlateauNorByARunThatEndsInARise) {
  EXPECT_FALSE(onset_of([](double) { return 1.0; }, 0.8));
  EXPECT_FALSE(onset_of(flat_then_steep(0.6), 0.61)) << "a rise by a half only at its end";
  EXPECT_FALSE(onset_of([](double) { return 0.0; }, 0.8));
  EXPECT_FALSE(onset_of(flat_then_steep(0.1), 0.19)) << "before the plateau is looked for";
  EXPECT_FALSE(onset_of([](double e) { return std::sin(20.0 * e); }, 0.8)) << "stresses of both signs";
}

/// A crush of a small specimen.
struct SmallCrush {
  LoadingSpec::Direction direction;
  double speed;  // m/s
};
class DensificationOfACrush : public testing::TestWithParam<SmallCrush> {};

TEST_P(DensificationOfACrush, IsFoundOnceTheSupportBearsThePlateauToo) {
  SceneSpec spec = scenes::hexagon_specimen(20, 7);
  spec.loading.direction = GetParam().direction;
  spec.loading.speed_m_per_s = GetParam().speed;
  spec.loading.end_strain = 0.92;
  const auto samples = scenes::run_frame(spec);
  const auto onset = onset_of(samples);
  ASSERT_TRUE(onset);
  EXPECT_GT(*onset, 0.6);
  EXPECT_LT(*onset, 0.9);
  const Curve support(samples, &Sample::stress_support);
  const Curve impact(samples, &Sample::stress_impact);
  EXPECT_GT(support.smoothed(0.914), *impact.mean(0.2, *onset)) << "The front has arrived.";
  std::vector<Sample> shorter = samples;
  std::erase_if(shorter, [&](const Sample& sample) { return sample.strain > *onset - 0.03; });
  EXPECT_FALSE(onset_of(shorter));
}

INSTANTIATE_TEST_SUITE_P(
    Of, DensificationOfACrush,
    testing::Values(SmallCrush{LoadingSpec::Direction::x, 10.0}, SmallCrush{LoadingSpec::Direction::x, 100.0},
                    SmallCrush{LoadingSpec::Direction::x, 150.0}, SmallCrush{LoadingSpec::Direction::y, 10.0},
                    SmallCrush{LoadingSpec::Direction::y, 100.0}, SmallCrush{LoadingSpec::Direction::y, 125.0}));

}  // namespace
}  // namespace cellcrush

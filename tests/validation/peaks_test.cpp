#include "validation/peaks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace cellcrush::validation {
namespace {

std::vector<Sample> samples_of(const std::function<double(double)>& stress, double end, int count) {
  std::vector<Sample> samples(count);
  for (int i = 0; i < count; ++i) {
    samples[i].strain = end * (i + 1) / count;
    samples[i].stress_impact = stress(end * (i + 0.5) / count);
  }
  return samples;
}

/// A plateau of 1 MPa with a bump of half a sine, 0.05 wide.
double bump(double strain, double middle, double height) {
  const double way = (strain - middle) / 0.05;
  return std::abs(way) < 0.5 ? height * std::cos(way * std::numbers::pi) : 0.0;
}

TEST(Peaks, AreCountedWhoseProminenceIsAShareOfThePlateau) {
  const auto stress = [](double e) { return 1.0 + bump(e, 0.2, 0.3) + bump(e, 0.3, 0.1) + bump(e, 0.4, 0.5); };
  const auto peaks = find_salient_peaks(samples_of(stress, 0.6, 1200), 0.6);
  ASSERT_EQ(peaks.size(), 2U);
  EXPECT_NEAR(peaks[0].strain, 0.2, 0.001);
  EXPECT_NEAR(peaks[0].prominence, 0.3, 0.01);
  EXPECT_NEAR(peaks[1].strain, 0.4, 0.001);
  EXPECT_NEAR(peaks[1].stress, 1.5, 0.01);
}

TEST(Peaks, OnTheShoulderOfAHigherOneAreMeasuredFromTheSaddle) {
  const auto stress = [](double e) { return e < 0.3 ? 1.0 + bump(e, 0.2, 0.5) : 1.4 + bump(e, 0.4, 0.5); };
  const auto peaks = find_salient_peaks(samples_of(stress, 0.6, 1200), 0.6);
  ASSERT_EQ(peaks.size(), 2U);
  EXPECT_NEAR(peaks[0].prominence, 0.5, 0.01);
  EXPECT_NEAR(peaks[1].prominence, 0.5, 0.01);
}

TEST(Peaks, AreNotMadeByWhatRingsFasterThanTheSmoothing) {
  const auto stress = [](double e) { return 1.0 + 0.5 * std::sin(2.0 * std::numbers::pi * e / 0.001); };
  EXPECT_TRUE(find_salient_peaks(samples_of(stress, 0.5, 5000), 0.5).empty());
}

TEST(Peaks, AreNotMadeByTheWaveOfASuddenStart) {
  const auto stress = [](double e) { return e < 0.003 ? 9.0 : 1.0 + bump(e, 0.05, 0.5); };
  const auto peaks = find_salient_peaks(samples_of(stress, 0.5, 1000), 0.5);
  ASSERT_EQ(peaks.size(), 1U);
  EXPECT_NEAR(peaks[0].strain, 0.05, 0.001);
}

TEST(Peaks, BeyondTheLastStrainAndRisesThatDoNotFallAreNone) {
  const auto stress = [](double e) { return 1.0 + bump(e, 0.2, 0.5) + bump(e, 0.55, 0.5) + (e > 0.4 ? e - 0.4 : 0.0); };
  const auto peaks = find_salient_peaks(samples_of(stress, 0.6, 1200), 0.5);
  ASSERT_EQ(peaks.size(), 1U);
  EXPECT_NEAR(peaks[0].strain, 0.2, 0.001);
}

}  // namespace
}  // namespace cellcrush::validation

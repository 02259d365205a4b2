#include "measure/curve.h"

#include <gtest/gtest.h>

#include <functional>

#include "cellcrush/simulation.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

/// Samples of a curve with the exact interval means of a stress given by its integral.
std::vector<Sample> samples_of(const std::function<double(double)>& integral, double end, int count) {
  std::vector<Sample> samples;
  for (int i = 1; i <= count; ++i) {
    Sample sample;
    const double before = end * (i - 1) / count;
    sample.strain = end * i / count;
    sample.stress_impact = (integral(sample.strain) - integral(before)) / (sample.strain - before);
    samples.push_back(sample);
  }
  return samples;
}

TEST(Curve, PlateauIsTheMeanOfTheWindowWhateverTheSampling) {
  const auto integral = [](double e) { return e + e * e; };  // stress 1 + 2 e, mean over .2-.4: 1.6
  for (const int count : {80, 97, 1000}) {
    const Curve curve(samples_of(integral, 0.8, count), &Sample::stress_impact);
    EXPECT_NEAR(*curve.mean(0.2, 0.4), 1.6, 1e-3) << count;
  }
}

TEST(Curve, PlateauIsAbsentBeforeTheWindowIsFull) {
  const Curve curve(samples_of([](double e) { return e; }, 0.39, 100), &Sample::stress_impact);
  EXPECT_FALSE(curve.mean(0.2, 0.4).has_value());
}

TEST(Curve, SmoothedIsTheMeanOfAWindow) {
  const auto integral = [](double e) { return e * e; };  // stress 2 e
  const Curve curve(samples_of(integral, 0.8, 800), &Sample::stress_impact);
  EXPECT_NEAR(curve.smoothed(0.3, 0.02), 0.6, 1e-9);
  EXPECT_NEAR(curve.smoothed(0.3), 0.6, 1e-9);
}

TEST(Curve, OfBothPlatesIsTheMeanOfTheirStresses) {
  auto samples = samples_of([](double e) { return 3.0 * e; }, 0.5, 100);
  for (Sample& sample : samples) sample.stress_support = 1.0;
  EXPECT_NEAR(*curve_of_both_plates(samples).mean(0.1, 0.4), 2.0, 1e-9);
}

TEST(Theory, TypeIHasGibsonAshbyAndEquation51) {
  const auto scene = scenes::build(scenes::hexagon_specimen(74, 21));
  const Theory theory = facts_of(*scene).theory;
  EXPECT_NEAR(theory.gibson_ashby, 2.0 / 3.0 * 76.0 * 0.0866 * 0.0866, 1e-9);
  const double density = 72.1438e-6 / (512.687 * 128.0 * 4.0);
  EXPECT_NEAR(theory.shock, theory.gibson_ashby + density * 1e10 / theory.densification_strain, 2e-4);
}

}  // namespace
}  // namespace cellcrush

#include "scenes/dynamic_claims.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace cellcrush::scenes {
namespace {

void record(const std::string& name, double value) { testing::Test::RecordProperty(name, std::to_string(value)); }

/// Mean of a quantity over samples of even spacing, weighted by 1 - cos over their whole time: vibrations fall out.
template <class Quantity>
double windowed_mean(const std::vector<Sample>& samples, Quantity&& quantity) {
  double sum = 0.0;
  double weights = 0.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double weight =
        1.0 - std::cos(2.0 * std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(samples.size()));
    sum += weight * quantity(samples[i]);
    weights += weight;
  }
  return sum / weights;
}

double tip_deflection(const Sample& sample) { return sample.watched.front().uy; }

}  // namespace

std::pair<double, double> expect_parkes(const std::vector<Sample>& samples) {
  // The first moment of rest is the first maximum; what is left of the motion then is elastic.
  std::size_t peak = 1;
  while (peak + 1 < samples.size() && tip_deflection(samples[peak + 1]) > tip_deflection(samples[peak])) {
    ++peak;
  }
  const std::vector<Sample> rest(samples.begin() + static_cast<std::ptrdiff_t>(peak), samples.end());
  const double deflection = windowed_mean(rest, tip_deflection) / StruckCantilever::final_deflection();
  const double duration = samples[peak].time / StruckCantilever::duration();
  const double energy = 0.5 * StruckCantilever::kTipMass * StruckCantilever::kSpeed * StruckCantilever::kSpeed;
  record("deflection_ratio", deflection);
  record("duration_ratio", duration);
  record("plastic_share", samples.back().energies.plastic / energy);
  EXPECT_NEAR(deflection, 1.0, 0.02);
  EXPECT_NEAR(duration, 1.0, 0.03);
  EXPECT_NEAR(samples.back().energies.plastic / energy, 1.0, 0.01);
  return {deflection, duration};
}

std::pair<double, double> expect_steady_stretch(const std::vector<Sample>& samples, int elements) {
  const auto stretch = [](const Sample& sample) {
    const double x = 2.0 * SpinningBar::kHalfLength + sample.watched[1].ux - sample.watched[0].ux;
    const double y = sample.watched[1].uy - sample.watched[0].uy;
    return 0.5 * std::hypot(x, y) / SpinningBar::kHalfLength - 1.0;
  };
  // Element i from the middle bears the pull of all masses j >= i at r_j, the last of half an element.
  double lumped = 0.0;
  const double n = elements;
  for (int i = 1; i <= elements; ++i) {
    for (int j = i; j <= elements; ++j) {
      lumped += 3.0 * SpinningBar::kStretch / (n * n * n) * (j == elements ? 0.5 : 1.0) * j;
    }
  }
  const double mean = windowed_mean(samples, stretch);
  record("stretch_over_lumped", mean / lumped);
  record("stretch_over_continuous", mean / SpinningBar::kStretch);
  EXPECT_NEAR(mean / lumped, 1.0, 1e-3);
  EXPECT_NEAR(mean / SpinningBar::kStretch, 1.0, 1e-3 + 1.0 / (n * n));
  const auto total = [](const Sample& sample) { return sample.energies.kinetic + sample.energies.elastic; };
  double swing = 0.0;
  for (const Sample& sample : samples) {
    swing = std::max(swing, std::abs(total(sample) / total(samples.front()) - 1.0));
  }
  const auto middle = samples.begin() + static_cast<std::ptrdiff_t>(samples.size() / 2);
  const double drift =
      windowed_mean({middle, samples.end()}, total) / windowed_mean({samples.begin(), middle}, total) - 1.0;
  record("energy_swing_times_1e9", 1e9 * swing);
  record("energy_drift_times_1e9", 1e9 * drift);
  EXPECT_LT(swing, 5e-6);
  EXPECT_LT(std::abs(drift), 0.2 * swing);
  return {mean / lumped, drift};
}

double expect_dynamic_factor(const std::vector<Sample>& samples, const StepLoadedCantilever& cantilever) {
  double greatest = 0.0;
  double exact = 0.0;
  for (const Sample& sample : samples) {
    greatest = std::max(greatest, tip_deflection(sample));
    exact = std::max(exact, cantilever.deflection_at(sample.time));
  }
  record("dynamic_factor", greatest / cantilever.static_deflection);
  record("dynamic_factor_exact", exact / cantilever.static_deflection);
  EXPECT_NEAR(greatest / exact, 1.0, 0.01);
  return greatest / cantilever.static_deflection;
}

double modal_error(const std::vector<Sample>& samples, const StepLoadedCantilever& cantilever) {
  double sum = 0.0;
  for (const Sample& sample : samples) {
    const double difference = tip_deflection(sample) - cantilever.deflection_at(sample.time);
    sum += difference * difference;
  }
  return std::sqrt(sum / static_cast<double>(samples.size())) / cantilever.static_deflection;
}

}  // namespace cellcrush::scenes

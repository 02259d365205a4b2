#include "scenes/dynamic_frames.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "scenes/frames.h"

namespace cellcrush::scenes {
namespace {

using Component = FrameLattice::Component;

constexpr double kGramPerTonne = 1e6;
constexpr double kMetrePerMm = 1e-3;

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

double StruckCantilever::final_deflection() {
  const double ratio = kMassPerLength * kLength / (2.0 * kTipMass);
  return kTipMass * kTipMass * kSpeed * kSpeed / (3.0 * kMassPerLength * kFullMoment) *
         (ratio / (1.0 + ratio) + 2.0 * std::log(1.0 + ratio));
}

double StruckCantilever::duration() { return kTipMass * kSpeed * kLength / kFullMoment; }

SceneSpec StruckCantilever::spec(int elements, double end_time) {
  FrameLattice frame = bar(kLength, kThickness, elements);
  const double own = kMassPerLength * kLength / (2.0 * elements);
  frame.nodes[1].attached_mass_g = (kTipMass - own) * kGramPerTonne;
  frame.supports = {{0, true, true, true}};
  frame.initial_velocities = {{1, 0.0, kSpeed * kMetrePerMm, 0.0}};
  frame.watched_nodes = {1};
  frame.end_time_s = end_time;
  SceneSpec spec = plastic_frame(std::move(frame), kModulus, kYieldStress);
  spec.output.sample_count = 1000;
  return spec;
}

double SpinningBar::wave_speed() { return std::sqrt(70000.0 / 2.7e-9); }  // of elastic_frame's aluminium
double SpinningBar::spin() { return wave_speed() * std::sqrt(3.0 * kStretch) / kHalfLength; }
double SpinningBar::axial_period() { return 4.0 * kHalfLength / wave_speed(); }

SceneSpec SpinningBar::spec(int elements, double periods) {
  FrameLattice frame;
  for (int i = 0; i <= 2 * elements; ++i) {
    const double x = -kHalfLength + 2.0 * kHalfLength * i / (2 * elements);
    frame.nodes.push_back({x, 0.0, 0.0, 0.0});
    if (i > 0) frame.beams.push_back(beam(i - 1, i, kThickness, 1));
    frame.initial_velocities.push_back({i, 0.0, spin() * x * kMetrePerMm, spin()});
  }
  frame.watched_nodes = {0, 2 * elements};
  frame.end_time_s = periods * axial_period();
  SceneSpec spec = elastic_frame(std::move(frame));
  spec.output.sample_count = 4000;
  return spec;
}

double StepLoadedCantilever::first_period() const {
  const double wave_speed = std::sqrt(modulus / (density_kg_per_m3 * 1e-12));
  constexpr double kRoot = 1.875104068711961;
  return 2.0 * std::numbers::pi * length * length / (kRoot * kRoot * wave_speed * thickness / std::sqrt(12.0));
}

double StepLoadedCantilever::deflection_at(double time) const {
  // Roots of cos z cosh z = -1. A unit load at the tip moves mode i by 4 / (rho A L omega_i^2) (1 - cos omega_i t), and
  // EI / L^3 of that is 4 / z^4; all modes' sum at rest is 1 / 3.
  constexpr std::array<double, 5> kRoots = {1.875104068711961, 4.694091132974175, 7.854757438237613, 10.995540734875467,
                                            14.137168391046471};
  constexpr int kModes = 40;
  double sum = 0.0;
  for (int i = 0; i < kModes; ++i) {
    const double root = i < 5 ? kRoots[i] : (i + 0.5) * std::numbers::pi;
    const double turn = 2.0 * std::numbers::pi * time / first_period() * (root * root) / (kRoots[0] * kRoots[0]);
    sum += 4.0 / (root * root * root * root) * (1.0 - std::cos(turn));
  }
  return 3.0 * static_deflection * sum;
}

SceneSpec StepLoadedCantilever::spec(int elements, double end_time, int steps) const {
  const double stiffness = modulus * thickness * thickness * thickness / 12.0;
  FrameLattice frame = bar(length, thickness, elements);
  frame.supports = {{0, true, true, true}};
  frame.loads = {{1, Component::y, {{0.0, 3.0 * stiffness * static_deflection / (length * length * length)}}}};
  frame.watched_nodes = {1};
  frame.end_time_s = end_time;
  SceneSpec spec = plastic_frame(std::move(frame), modulus, 1e9, density_kg_per_m3);
  spec.numerics.time_step_s = steps > 0 ? end_time / steps : 0.0;
  spec.output.sample_count = 200;
  return spec;
}

Rest rest_of(const std::vector<Sample>& samples) {
  // The first moment of rest is the first maximum; what is left of the motion then is elastic.
  std::size_t peak = 1;
  while (peak + 1 < samples.size() && tip_deflection(samples[peak + 1]) > tip_deflection(samples[peak])) ++peak;
  const std::vector<Sample> rest(samples.begin() + static_cast<std::ptrdiff_t>(peak), samples.end());
  return {samples[peak].time, windowed_mean(rest, tip_deflection)};
}

std::pair<double, double> expect_parkes(const std::vector<Sample>& samples) {
  const Rest rest = rest_of(samples);
  const double deflection = rest.deflection / StruckCantilever::final_deflection();
  const double duration = rest.time / StruckCantilever::duration();
  const double energy = 0.5 * StruckCantilever::kTipMass * StruckCantilever::kSpeed * StruckCantilever::kSpeed;
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
  EXPECT_NEAR(greatest / exact, 1.0, 0.01);
  return greatest / cantilever.static_deflection;
}

}  // namespace cellcrush::scenes

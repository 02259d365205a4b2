#include "scenes/textbook.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scenes/frames.h"

namespace cellcrush::scenes {
namespace {

using Component = FrameLattice::Component;

/// Mass damping over the first natural frequency: enough to let the start fade, too little to bear a load.
constexpr double kDamping = 0.4;

/// First natural frequency of a cantilever, 1/s; thickness and length in mm.
double cantilever_frequency(double length, double thickness, double modulus, double density_kg_per_m3) {
  const double wave_speed = std::sqrt(modulus / (density_kg_per_m3 * 1e-12));
  return 3.516 * wave_speed * thickness / std::sqrt(12.0) / (length * length);
}

SceneSpec frame_spec(FrameLattice frame, double modulus, double yield_stress, double frequency, double periods) {
  frame.end_time_s = periods * 2.0 * std::numbers::pi / frequency;
  SceneSpec spec = plastic_frame(std::move(frame), modulus, yield_stress);
  spec.numerics.mass_damping_per_s = kDamping * frequency;
  spec.output.sample_count = 400;
  return spec;
}

/// A plastic frame whose node `node` is moved steadily to `way`; it is watched.
SceneSpec pushed(FrameLattice frame, int node, Component component, double way, double periods) {
  const double frequency = PlasticFrame::frequency();
  const double end = periods * 2.0 * std::numbers::pi / frequency;
  frame.motions = {{node, component, {{0.0, 0.0}, {end, way}}}};
  frame.watched_nodes = {node};
  return frame_spec(std::move(frame), PlasticFrame::kModulus, PlasticFrame::kYieldStress, frequency, periods);
}

/// Plastic work of each cycle of equal length in time.
std::vector<double> plastic_work_by_cycle(const std::vector<Sample>& samples, int cycles) {
  const double period = samples.back().time / cycles;
  std::vector<double> total(cycles, 0.0);
  for (const Sample& sample : samples) {
    const int cycle = std::min(cycles - 1, static_cast<int>(sample.time / period * (1.0 - 1e-12)));
    total[cycle] = sample.energies.plastic;
  }
  for (int i = cycles - 1; i > 0; --i) {
    total[i] -= total[i - 1];
  }
  return total;
}

}  // namespace

SceneSpec bent_cantilever(double peak) {
  FrameLattice frame = bar(PlasticFrame::kLength, PlasticFrame::kThickness, 8);
  frame.supports = {{0, true, true, true}};
  frame.watched_nodes = {1};
  const double frequency = PlasticFrame::frequency();
  constexpr double kPeriods = 320.0;  // of the first natural frequency
  const double end = kPeriods * 2.0 * std::numbers::pi / frequency;
  frame.loads = {{1, Component::rotation, {{0.0, 0.0}, {0.5 * end, peak * PlasticFrame::kYieldMoment}, {end, 0.0}}}};
  SceneSpec spec =
      frame_spec(std::move(frame), PlasticFrame::kModulus, PlasticFrame::kYieldStress, frequency, kPeriods);
  spec.material.hardening_modulus_mpa = PlasticFrame::kModulus / 99.0;  // E E_T / (E - E_T) with E_T = E / 100
  spec.section.depth_points = 10;
  return spec;
}

double PlasticFrame::frequency() { return cantilever_frequency(kLength, kThickness, kModulus, 7850.0); }

SceneSpec pushed_cantilever(double deflection, int elements) {
  FrameLattice frame = bar(PlasticFrame::kLength, PlasticFrame::kThickness, elements);
  frame.supports = {{0, true, true, true}};
  return pushed(std::move(frame), 1, Component::y, deflection, 40.0);
}

SceneSpec pushed_clamped_beam(double deflection, int elements) {
  FrameLattice frame;
  frame.nodes = {
      {0.0, 0.0, 0.0, 0.0}, {0.5 * PlasticFrame::kLength, 0.0, 0.0, 0.0}, {PlasticFrame::kLength, 0.0, 0.0, 0.0}};
  frame.beams = {beam(0, 1, PlasticFrame::kThickness, elements), beam(1, 2, PlasticFrame::kThickness, elements)};
  frame.supports = {{0, true, true, true}, {2, false, true, true}};
  return pushed(std::move(frame), 1, Component::y, deflection, 40.0);
}

SceneSpec pushed_portal(double sway, int elements) {
  const double length = PlasticFrame::kLength;
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {0.0, length, 0.0, 0.0}, {length, length, 0.0, 0.0}, {length, 0.0, 0.0, 0.0}};
  for (int i = 0; i < 3; ++i) {
    frame.beams.push_back(beam(i, i + 1, PlasticFrame::kThickness, elements));
  }
  frame.supports = {{0, true, true, true}, {3, true, true, true}};
  return pushed(std::move(frame), 1, Component::x, sway, 60.0);
}

SceneSpec cycled_bar(double isotropic_fraction, double strain, int cycles) {
  const double length = 10.0;
  FrameLattice frame = bar(length, 1.0, 1);
  frame.supports = {{0, true, true, true}, {1, false, true, true}};
  frame.watched_nodes = {1};
  const double frequency = std::sqrt(200000.0 / 7.85e-9) / length;  // axial
  const double quarter = 60.0 / frequency;
  FrameLattice::TimeFunction points = {{0.0, 0.0}};
  for (int i = 0; i < cycles; ++i) {
    points.emplace_back((4.0 * i + 1.0) * quarter, strain * length);
    points.emplace_back((4.0 * i + 3.0) * quarter, -strain * length);
  }
  points.emplace_back(4.0 * cycles * quarter, 0.0);
  frame.motions = {{1, Component::x, points}};
  frame.end_time_s = 4.0 * cycles * quarter;
  SceneSpec spec = plastic_frame(std::move(frame), 200000.0, 200.0);
  spec.material.hardening_modulus_mpa = 20000.0;
  spec.material.isotropic_fraction = isotropic_fraction;
  spec.output.sample_count = 40 * cycles;
  return spec;
}

SceneSpec lee_frame(double deflection) {
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {0.0, 120.0, 0.0, 0.0}, {24.0, 120.0, 0.0, 0.0}, {120.0, 120.0, 0.0, 0.0}};
  frame.beams = {beam(0, 1, 2.0, 20), beam(1, 2, 2.0, 4), beam(2, 3, 2.0, 16)};
  frame.supports = {{0, true, true, false}, {3, true, true, false}};
  const double frequency = cantilever_frequency(120.0, 2.0, 720.0, 7850.0);
  const double periods = 40.0;
  const double end = periods * 2.0 * std::numbers::pi / frequency;
  frame.motions = {{2, Component::y, {{0.0, 0.0}, {end, -deflection}}}};
  frame.watched_nodes = {2};
  SceneSpec spec = frame_spec(std::move(frame), 720.0, 1e9, frequency, periods);
  spec.depth_mm = 3.0;
  return spec;
}

SceneSpec buckled_column(double load_ratio) {
  SceneSpec spec = Cantilever::spec(32, Component::x, 0.0, 1.0, 1.0);
  auto& frame = std::get<FrameWalls>(spec.lattice);
  const double time_unit = 1.0 / Cantilever::first_frequency();
  const double buckling_load =
      std::numbers::pi * std::numbers::pi * Cantilever::kStiffness / (4.0 * Cantilever::kLength * Cantilever::kLength);
  const double nudge = 0.02 * buckling_load;
  spec.loads.loads = {{1, Component::x, {{0.0, 0.0}, {20.0 * time_unit, -load_ratio * buckling_load}}},
                      {1, Component::y, {{0.0, nudge}, {20.0 * time_unit, nudge}, {40.0 * time_unit, 0.0}}}};
  frame.watched_nodes = {1};
  spec.loading.end_time_s = 100.0 * time_unit;
  spec.numerics.mass_damping_per_s = kDamping * Cantilever::first_frequency();
  return spec;
}

std::vector<ForceAt> force_curve(const std::vector<Sample>& samples, double WatchedNode::*component) {
  std::vector<ForceAt> curve;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const double before = samples[i - 1].watched.front().*component;
    const double after = samples[i].watched.front().*component;
    curve.push_back(
        {0.5 * (before + after), (samples[i].energies.external - samples[i - 1].energies.external) / (after - before)});
  }
  return curve;
}

std::pair<double, double> expect_moment_curvature_law(const std::vector<Sample>& samples, double peak) {
  const double yield_moment = PlasticFrame::kYieldMoment;
  const double yield_curvature = yield_moment / PlasticFrame::kStiffness;
  const double end = samples.back().time;
  const auto moment_at = [&](double time) { return peak * yield_moment * 2.0 * std::min(time, end - time) / end; };
  double worst = 0.0;
  for (const Sample& sample : samples) {
    const double ratio = sample.watched.front().rotation / PlasticFrame::kLength / yield_curvature;
    if (sample.time < 0.5 * end && ratio > 0.5) {
      const double exact = ratio <= 1.0 ? ratio : 0.99 * (1.5 - 0.5 / (ratio * ratio)) + 0.01 * ratio;
      worst = std::max(worst, std::abs(moment_at(sample.time) / yield_moment / exact - 1.0));
    }
  }
  EXPECT_LT(worst, 0.01);
  const Sample& top = samples[samples.size() * 6 / 10];
  const Sample& bottom = samples[samples.size() * 9 / 10];
  const double slope = (moment_at(top.time) - moment_at(bottom.time)) * PlasticFrame::kLength /
                       (top.watched.front().rotation - bottom.watched.front().rotation);
  EXPECT_NEAR(slope / PlasticFrame::kStiffness, 1.0, 0.01);
  EXPECT_GT(samples.back().watched.front().rotation / PlasticFrame::kLength / yield_curvature, 0.5);
  return {worst, slope / PlasticFrame::kStiffness - 1.0};
}

double expect_closed_cycles(const std::vector<Sample>& samples, int cycles) {
  const std::vector<double> work = plastic_work_by_cycle(samples, cycles);
  double worst = 0.0;
  for (int i = 2; i < cycles; ++i) {
    worst = std::max(worst, std::abs(work[i] / work[1] - 1.0));
    EXPECT_NEAR(work[i] / work[1], 1.0, 0.01) << "cycle " << i + 1;
  }
  EXPECT_GT(work[1], 0.0);
  return worst;
}

double expect_shakedown(const std::vector<Sample>& samples, int cycles) {
  const std::vector<double> work = plastic_work_by_cycle(samples, cycles);
  for (int i = cycles / 2; i < cycles; ++i) {
    EXPECT_LT(work[i], 0.9 * work[i - 1]) << "cycle " << i + 1;
  }
  const double share = work.back() / *std::max_element(work.begin(), work.end());
  EXPECT_LT(share, 0.2);
  return share;
}

double expect_limit_load(const std::vector<Sample>& samples, double WatchedNode::*component, double factor) {
  const double limit = factor * PlasticFrame::kFullMoment / PlasticFrame::kLength;
  const std::vector<ForceAt> curve = force_curve(samples, component);
  const auto mean_force = [&](std::size_t from, std::size_t to) {
    double sum = 0.0;
    for (std::size_t i = from; i < to; ++i) {
      sum += std::abs(curve[i].force);
    }
    return sum / static_cast<double>(to - from);
  };
  const double before = mean_force(curve.size() * 6 / 10, curve.size() * 8 / 10);
  const double last = mean_force(curve.size() * 8 / 10, curve.size());
  EXPECT_NEAR(last / limit, 1.0, 0.01);
  EXPECT_NEAR(last / before, 1.0, 0.02);  // it stays there
  return last / limit;
}

std::pair<double, double> expect_lee_limit(const std::vector<Sample>& samples) {
  const std::vector<ForceAt> curve = force_curve(samples, &WatchedNode::uy);
  const auto peak = std::max_element(curve.begin(), curve.end(),
                                     [](const ForceAt& a, const ForceAt& b) { return -a.force < -b.force; });
  EXPECT_NEAR(-peak->force, 1.8557, 0.01 * 1.8557);
  EXPECT_NEAR(-peak->displacement, 48.74, 1.0);
  return {-peak->force, -peak->displacement};
}

double expect_end_angle(const std::vector<Sample>& samples, double degrees) {
  const double error = samples.back().watched.front().rotation * 180.0 / std::numbers::pi / degrees - 1.0;
  EXPECT_LT(std::abs(error), 0.015) << degrees;
  return error;
}

}  // namespace cellcrush::scenes

#include "scenes/dynamic_frames.h"

#include <array>
#include <cmath>
#include <numbers>

#include "scenes/frames.h"

namespace cellcrush::scenes {
namespace {

using Component = FrameLattice::Component;

constexpr double kGramPerTonne = 1e6;
constexpr double kMetrePerMm = 1e-3;

// Of elastic_frame's aluminium.
double aluminium_wave_speed() { return std::sqrt(70000.0 / 2.7e-9); }

/// Nodes along x from `from`, and a beam of one element between neighbours.
void add_bar(double from, double length, double thickness, int elements, FrameLattice& frame) {
  const int first = static_cast<int>(frame.nodes.size());
  for (int i = 0; i <= elements; ++i) {
    frame.nodes.push_back({from + length * i / elements, 0.0, 0.0, 0.0});
    if (i > 0) {
      frame.beams.push_back(beam(first + i - 1, first + i, thickness, 1));
    }
  }
}

}  // namespace

double StruckCantilever::final_deflection() {
  const double ratio = kMassPerLength * kLength / (2.0 * kTipMass);
  return kTipMass * kTipMass * kSpeed * kSpeed / (3.0 * kMassPerLength * kFullMoment) *
         (ratio / (1.0 + ratio) + 2.0 * std::log(1.0 + ratio));
}

double StruckCantilever::duration() { return kTipMass * kSpeed * kLength / kFullMoment; }

SceneSpec StruckCantilever::spec(int elements, double end_time) {
  FrameLattice frame;
  const double own = kMassPerLength * kLength / (2.0 * elements);
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {kLength, 0.0, (kTipMass - own) * kGramPerTonne, 0.0}};
  frame.beams = {beam(0, 1, kThickness, elements)};
  frame.supports = {{0, true, true, true}};
  frame.initial_velocities = {{1, 0.0, kSpeed * kMetrePerMm, 0.0}};
  frame.watched_nodes = {1};
  frame.end_time_s = end_time;
  SceneSpec spec = elastic_frame(std::move(frame));
  spec.material.youngs_modulus_mpa = kModulus;
  spec.material.yield_stress_mpa = kYieldStress;
  spec.material.density_kg_per_m3 = 7850.0;
  spec.output.sample_count = 1000;
  return spec;
}

double SpinningBar::wave_speed() { return aluminium_wave_speed(); }
double SpinningBar::spin() { return wave_speed() * std::sqrt(3.0 * kStretch) / kHalfLength; }
double SpinningBar::axial_period() { return 4.0 * kHalfLength / wave_speed(); }

SceneSpec SpinningBar::spec(int elements, double periods) {
  FrameLattice frame;
  add_bar(-kHalfLength, 2.0 * kHalfLength, kThickness, 2 * elements, frame);
  for (std::size_t i = 0; i < frame.nodes.size(); ++i) {
    frame.initial_velocities.push_back({static_cast<int>(i), 0.0, spin() * frame.nodes[i].x_mm * kMetrePerMm, spin()});
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
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {length, 0.0, 0.0, 0.0}};
  frame.beams = {beam(0, 1, thickness, elements)};
  frame.supports = {{0, true, true, true}};
  frame.loads = {{1, Component::y, {{0.0, 3.0 * stiffness * static_deflection / (length * length * length)}}}};
  frame.watched_nodes = {1};
  frame.end_time_s = end_time;
  SceneSpec spec = elastic_frame(std::move(frame));
  spec.material.youngs_modulus_mpa = modulus;
  spec.material.density_kg_per_m3 = density_kg_per_m3;
  spec.numerics.time_step_s = steps > 0 ? end_time / steps : 0.0;
  spec.output.sample_count = 200;
  return spec;
}

double BarImpact::wave_speed() { return aluminium_wave_speed(); }

SceneSpec BarImpact::spec(int elements) {
  FrameLattice frame;
  add_bar(0.0, kLength, kThickness, elements, frame);
  for (int i = 0; i <= elements; ++i) {
    frame.initial_velocities.push_back({i, kSpeed * kMetrePerMm, 0.0, 0.0});
  }
  add_bar(kLength + kThickness + kGap, kLength, kThickness, elements, frame);
  frame.self_contact = true;
  frame.end_time_s = kGap / kSpeed + 2.0 * duration();
  SceneSpec spec = elastic_frame(std::move(frame));
  spec.contact.damping_ratio = 0.0;
  spec.contact.stiffness_factor = 0.25;
  spec.output.sample_count = 2000;
  return spec;
}

}  // namespace cellcrush::scenes

#include "scenes/textbook.h"

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
  SceneSpec spec;
  put_frame(frame, spec);
  spec.depth_mm = 1.0;
  spec.material.youngs_modulus_mpa = modulus;
  spec.material.yield_stress_mpa = yield_stress;
  spec.material.density_kg_per_m3 = 7850.0;
  spec.numerics.mass_damping_per_s = kDamping * frequency;
  spec.output.sample_count = 400;
  return spec;
}

/// A plastic frame whose node `node` is moved steadily to `way`; it is watched.
SceneSpec pushed(FrameLattice frame, int node, Component component, double way, double periods) {
  const double frequency =
      cantilever_frequency(PlasticFrame::kLength, PlasticFrame::kThickness, PlasticFrame::kModulus, 7850.0);
  const double end = periods * 2.0 * std::numbers::pi / frequency;
  frame.motions = {{node, component, {{0.0, 0.0}, {end, way}}}};
  frame.watched_nodes = {node};
  return frame_spec(std::move(frame), PlasticFrame::kModulus, PlasticFrame::kYieldStress, frequency, periods);
}

}  // namespace

SceneSpec bent_cantilever(double peak) {
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {PlasticFrame::kLength, 0.0, 0.0, 0.0}};
  frame.beams = {beam(0, 1, PlasticFrame::kThickness, 8)};
  frame.supports = {{0, true, true, true}};
  frame.watched_nodes = {1};
  const double frequency =
      cantilever_frequency(PlasticFrame::kLength, PlasticFrame::kThickness, PlasticFrame::kModulus, 7850.0);
  const double end = 80.0 * 2.0 * std::numbers::pi / frequency;
  frame.loads = {{1, Component::rotation, {{0.0, 0.0}, {0.5 * end, peak * PlasticFrame::kYieldMoment}, {end, 0.0}}}};
  SceneSpec spec = frame_spec(std::move(frame), PlasticFrame::kModulus, PlasticFrame::kYieldStress, frequency, 80.0);
  spec.material.hardening_modulus_mpa = PlasticFrame::kModulus / 99.0;  // E E_T / (E - E_T) with E_T = E / 100
  spec.section.depth_rule = SectionSpec::DepthRule::lobatto;
  spec.section.depth_points = 10;
  return spec;
}

SceneSpec pushed_cantilever(double deflection, int elements) {
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {PlasticFrame::kLength, 0.0, 0.0, 0.0}};
  frame.beams = {beam(0, 1, PlasticFrame::kThickness, elements)};
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
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {length, 0.0, 0.0, 0.0}};
  frame.beams = {beam(0, 1, 1.0, 1)};
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
  SceneSpec spec;
  put_frame(frame, spec);
  spec.depth_mm = 1.0;
  spec.material.youngs_modulus_mpa = 200000.0;
  spec.material.yield_stress_mpa = 200.0;
  spec.material.hardening_modulus_mpa = 20000.0;
  spec.material.isotropic_fraction = isotropic_fraction;
  spec.material.density_kg_per_m3 = 7850.0;
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
        {0.5 * (before + after), (samples[i].work_external - samples[i - 1].work_external) / (after - before)});
  }
  return curve;
}

}  // namespace cellcrush::scenes

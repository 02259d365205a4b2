#include "scenes/axial_moment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "scenes/frames.h"
#include "scenes/run_frame.h"
#include "scenes/textbook.h"

namespace cellcrush::scenes {
namespace {

using Component = FrameLattice::Component;

constexpr double kYieldForce = PlasticFrame::kYieldStress * PlasticFrame::kThickness;  // N_p, of a depth of 1 mm

/// First natural frequency of the cantilever, 1/s.
double frequency(double stiffening) {
  const double wave_speed = std::sqrt(stiffening * PlasticFrame::kModulus / 7.85e-9);
  return 3.516 * wave_speed * PlasticFrame::kThickness / std::sqrt(12.0) /
         (PlasticFrame::kLength * PlasticFrame::kLength);
}

/// Ends after some of the cantilever's periods.
SceneSpec spec_of(FrameLattice frame, double periods, double stiffening) {
  frame.end_time_s = periods * 2.0 * std::numbers::pi / frequency(stiffening);
  SceneSpec spec;
  put_frame(frame, spec);
  spec.depth_mm = 1.0;
  spec.material.youngs_modulus_mpa = stiffening * PlasticFrame::kModulus;
  spec.material.yield_stress_mpa = PlasticFrame::kYieldStress;
  spec.material.density_kg_per_m3 = 7850.0;
  spec.numerics.mass_damping_per_s = 0.4 * frequency(stiffening);
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  spec.output.sample_count = 400;
  return spec;
}

double end_of(double periods) { return periods * 2.0 * std::numbers::pi / frequency(1.0); }

/// Values of a curve of (abscissa, value) where it first comes to each of the abscissas, between its points.
std::vector<double> values_at(const std::vector<std::pair<double, double>>& curve, const std::vector<double>& at) {
  std::vector<double> values;
  for (const double abscissa : at) {
    const auto behind = std::ranges::find_if(curve, [&](const auto& point) { return point.first >= abscissa; });
    if (behind == curve.end() || behind == curve.begin()) {
      values.push_back(std::nan(""));
      continue;
    }
    const auto& [x0, y0] = *(behind - 1);
    const auto& [x1, y1] = *behind;
    values.push_back(y0 + (y1 - y0) * (abscissa - x0) / (x1 - x0));
  }
  return values;
}

}  // namespace

double root_moment_of_pulled_cantilever(double n, int elements, SectionSpec::AreaRule area) {
  constexpr double kPeriods = 60.0;
  const double pull = n * kYieldForce;
  const double end = end_of(kPeriods);
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {PlasticFrame::kLength, 0.0, 0.0, 0.0}};
  frame.beams = {beam(0, 1, PlasticFrame::kThickness, elements)};
  frame.supports = {{0, true, true, true}};
  frame.loads = {{1, Component::x, {{0.0, 0.0}, {0.2 * end, pull}}}};
  frame.motions = {{1, Component::y, {{0.0, 0.0}, {0.2 * end, 0.0}, {end, 0.1 * PlasticFrame::kLength}}}};
  SceneSpec spec = spec_of(std::move(frame), kPeriods, 1.0);
  spec.section.area_rule = area;
  const auto scene = build(spec);
  Simulation simulation(scene);
  double sum = 0.0;
  int count = 0;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(1);
    if (simulation.time() > 0.8 * end) {
      sum += std::abs(simulation.state().internal_moment[0]) / PlasticFrame::kFullMoment;
      ++count;
    }
  }
  return sum / count;
}

std::vector<double> forces_of_folded_strut(int elements, const std::vector<double>& deflections) {
  constexpr double kPeriods = 100.0;
  const double end = end_of(kPeriods);
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {PlasticFrame::kLength, 0.0, 0.0, 0.0}};
  frame.beams = {beam(0, 1, PlasticFrame::kThickness, elements)};
  frame.supports = {{0, true, true, true}, {1, false, true, true}};
  // The middle moves aside as the root of the travel of the end: steadily.
  FrameLattice::TimeFunction travel;
  for (int i = 0; i <= 100; ++i) {
    travel.emplace_back(0.01 * i * end, -0.065 * PlasticFrame::kLength * 1e-4 * i * i);
  }
  frame.motions = {{1, Component::x, travel}};
  const double bow = 0.5 * PlasticFrame::kFullMoment / (PlasticFrame::kLength * PlasticFrame::kLength);
  frame.distributed_loads = {{0, {}, {{0.0, bow}, {0.1 * end, bow}, {0.15 * end, 0.0}}}};
  frame.self_contact = false;
  const auto scene = build(spec_of(std::move(frame), kPeriods, 1.0));
  Simulation simulation(scene);
  const auto middle = static_cast<std::size_t>(2 + elements / 2 - 1);
  std::vector<std::pair<double, double>> curve;
  double force = 0.0;
  int count = 0;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(1);
    force += simulation.state().internal_force[1].x() / kYieldForce;
    if (++count == 200) {
      curve.emplace_back(simulation.state().position[middle].y() / PlasticFrame::kThickness, force / count);
      force = 0.0;
      count = 0;
    }
  }
  return values_at(curve, deflections);
}

std::vector<double> loads_of_held_beam(int elements, double stiffening, const std::vector<double>& deflections) {
  constexpr double kPeriods = 60.0;
  const double end = kPeriods * 2.0 * std::numbers::pi / frequency(stiffening);
  FrameLattice frame;
  frame.nodes = {
      {0.0, 0.0, 0.0, 0.0}, {0.5 * PlasticFrame::kLength, 0.0, 0.0, 0.0}, {PlasticFrame::kLength, 0.0, 0.0, 0.0}};
  frame.beams = {beam(0, 1, PlasticFrame::kThickness, elements), beam(1, 2, PlasticFrame::kThickness, elements)};
  frame.supports = {{0, true, true, true}, {2, true, true, true}};
  frame.motions = {{1, Component::y, {{0.0, 0.0}, {end, 2.2 * PlasticFrame::kThickness}}}};
  frame.watched_nodes = {1};
  std::vector<std::pair<double, double>> curve;
  SceneSpec spec = spec_of(std::move(frame), kPeriods, stiffening);
  for (const ForceAt& at : force_curve(run_frame(spec), &WatchedNode::uy)) {
    curve.emplace_back(at.displacement / PlasticFrame::kThickness,
                       at.force * PlasticFrame::kLength / (8.0 * PlasticFrame::kFullMoment));
  }
  return values_at(curve, deflections);
}

}  // namespace cellcrush::scenes

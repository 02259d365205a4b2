// Axial force and moment together on a perfectly plastic rectangle, of section and material of PlasticFrame: what no
// gate of pure bending sees. Its interaction is exact: M = M_p (1 - n^2), n = N / N_p.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/textbook.h"

namespace cellcrush {
namespace {

using scenes::PlasticFrame;
using Component = FrameLattice::Component;
using Curve = std::vector<std::pair<double, double>>;

constexpr double kYieldForce = PlasticFrame::kYieldStress * PlasticFrame::kThickness;  // N_p, of a depth of 1 mm

/// Time of so many periods of the cantilever, whose modulus is larger by a factor, s.
double time_of(double periods, double stiffening = 1.0) {
  return periods * 2.0 * std::numbers::pi / (PlasticFrame::frequency() * std::sqrt(stiffening));
}

SceneSpec slow_frame(FrameLattice frame, double end, double stiffening = 1.0) {
  frame.end_time_s = end;
  SceneSpec spec = scenes::in_double_precision(
      scenes::plastic_frame(std::move(frame), stiffening * PlasticFrame::kModulus, PlasticFrame::kYieldStress));
  spec.numerics.mass_damping_per_s = 0.4 * PlasticFrame::frequency() * std::sqrt(stiffening);
  spec.output.sample_count = 400;
  return spec;
}

/// Values of a curve where it first comes to each of the abscissas, between its points.
std::vector<double> values_at(const Curve& curve, const std::vector<double>& at) {
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

/// Root moment over M_p of a cantilever that is pulled by n N_p and then pushed aside by a tenth of its length: the
/// mean over the last quarter of the way, with the moments of both tip forces about the root in the deformed shape.
double root_moment_of_pulled_cantilever(double n, int elements) {
  const double end = time_of(60.0);
  FrameLattice frame = scenes::bar(PlasticFrame::kLength, PlasticFrame::kThickness, elements);
  frame.supports = {{0, true, true, true}};
  frame.loads = {{1, Component::x, {{0.0, 0.0}, {0.2 * end, n * kYieldForce}}}};
  frame.motions = {{1, Component::y, {{0.0, 0.0}, {0.2 * end, 0.0}, {end, 0.1 * PlasticFrame::kLength}}}};
  SceneSpec spec = slow_frame(std::move(frame), end);
  spec.section.area_rule = SectionSpec::AreaRule::constant_area;
  Simulation simulation(scenes::build(spec));
  double sum = 0.0;
  int count = 0;
  scenes::follow(simulation, [&](const State& state) {
    if (simulation.time() <= 0.8 * end) return;
    sum += std::abs(state.internal_moment[0]) / PlasticFrame::kFullMoment;
    ++count;
  });
  return sum / count;
}

// The figures are those of the 6 points through the depth; 1 - n^2 is exact.
TEST(AxialForceWithMoment, RootOfAPulledCantileverYieldsAtTheMomentThatItsAxialForceLeaves) {
  for (const auto& [n, of_rule] : {std::pair(0.0, 0.999), {0.3, 0.909}, {0.5, 0.726}, {0.7, 0.517}}) {
    const double of_pair = root_moment_of_pulled_cantilever(n, 2);
    EXPECT_NEAR(of_pair, of_rule, 0.005) << "n = " << n;
    scenes::record_figure("root moment at n = " + std::to_string(n).substr(0, 3), of_pair, 3, {1.0 - n * n, 0.03});
    for (const int elements : {1, 8}) {
      EXPECT_NEAR(root_moment_of_pulled_cantilever(n, elements) / of_pair, 1.0, 0.005) << elements << ", n = " << n;
    }
  }
}

/// Axial force over N_p of a clamped strut that its end folds, when its middle has moved aside by each of `deflections`
/// times its thickness, ascending.
std::vector<double> forces_of_folded_strut(int elements, const std::vector<double>& deflections) {
  const double end = time_of(100.0);
  FrameLattice frame = scenes::bar(PlasticFrame::kLength, PlasticFrame::kThickness, elements);
  frame.supports = {{0, true, true, true}, {1, false, true, true}};
  // The middle moves aside as the root of the travel of the end: steadily.
  FrameLattice::TimeFunction travel;
  for (int i = 0; i <= 100; ++i) {
    travel.emplace_back(0.01 * i * end, -0.065 * PlasticFrame::kLength * 1e-4 * i * i);
  }
  frame.motions = {{1, Component::x, travel}};
  const double bow = 0.5 * PlasticFrame::kFullMoment / (PlasticFrame::kLength * PlasticFrame::kLength);
  frame.distributed_loads = {{0, {}, {{0.0, bow}, {0.1 * end, bow}, {0.15 * end, 0.0}}}};
  Simulation simulation(scenes::build(slow_frame(std::move(frame), end)));
  const auto middle = static_cast<std::size_t>(2 + elements / 2 - 1);
  Curve curve;
  double force = 0.0;
  scenes::follow(simulation, [&](const State& state) {
    force += state.internal_force[1].x() / kYieldForce / 200.0;
    if (state.step % 200 != 0) return;
    curve.emplace_back(state.position[middle].y() / PlasticFrame::kThickness, std::exchange(force, 0.0));
  });
  return values_at(curve, deflections);
}

// Three hinges, rigid-plastic: n = sqrt(1 + (w / h)^2) - w / h.
TEST(AxialForceWithMoment, FoldedStrutHasTheForceOfItsThreeHinges) {
  const std::vector<double> deflections = {0.5, 1.0, 2.0, 4.0};
  const std::vector<double> most = {0.69, 0.44, 0.25, 0.127};
  const std::vector<double> of_eight = forces_of_folded_strut(8, deflections);
  for (const int elements : {2, 4}) {
    const std::vector<double> forces = forces_of_folded_strut(elements, deflections);
    double worst = 0.0;
    for (std::size_t i = 0; i < deflections.size(); ++i) {
      SCOPED_TRACE(testing::Message() << elements << " elements, w / h = " << deflections[i]);
      const double rigid_plastic = std::sqrt(1.0 + deflections[i] * deflections[i]) - deflections[i];
      EXPECT_LT(forces[i], most[i]);
      EXPECT_NEAR(forces[i] / rigid_plastic, 1.0, 0.02);
      EXPECT_NEAR(forces[i] / of_eight[i], 1.0, 0.02);
      worst = std::max(worst, std::abs(forces[i] / rigid_plastic - 1.0));
    }
    scenes::record_figure(std::to_string(elements) + " elements: worst error in %", 100.0 * worst, 2);
  }
}

/// Load over 8 M_p / L of a beam of two members of 20 times the modulus that is clamped at both ends, held along its
/// axis, and pushed at its middle, at each of `deflections` over thickness, ascending.
std::vector<double> loads_of_held_beam(int elements, const std::vector<double>& deflections) {
  constexpr double kStiffening = 20.0;
  const double end = time_of(60.0, kStiffening);
  FrameLattice frame =
      scenes::touching_beams({{0.0, 0.0}, {0.5 * PlasticFrame::kLength, 0.0}, {PlasticFrame::kLength, 0.0}},
                             {{0, 1}, {1, 2}}, PlasticFrame::kThickness, elements);
  frame.self_contact = false;
  frame.supports = {{0, true, true, true}, {2, true, true, true}};
  frame.motions = {{1, Component::y, {{0.0, 0.0}, {end, 2.2 * PlasticFrame::kThickness}}}};
  frame.watched_nodes = {1};
  Curve curve;
  const std::vector<Sample> samples = scenes::run_frame(slow_frame(std::move(frame), end, kStiffening));
  for (const scenes::ForceAt& at : scenes::force_curve(samples, &WatchedNode::uy)) {
    curve.emplace_back(at.displacement / PlasticFrame::kThickness,
                       at.force * PlasticFrame::kLength / (8.0 * PlasticFrame::kFullMoment));
  }
  return values_at(curve, deflections);
}

// Rigid-plastic: 1 + (W / h)^2 up to W = h, then 2 W / h. A pulled beam keeps its area (E5c). If it thinned, it would
// neck in its shortest elements.
TEST(AxialForceWithMoment, HeldBeamPassesFromBendingToPull) {
  const std::vector<double> deflections = {0.5, 1.0, 1.5, 2.0};
  const std::vector<double> of_two = loads_of_held_beam(2, deflections);
  double worst = 0.0;
  for (const int elements : {2, 4, 8}) {
    const std::vector<double> loads = loads_of_held_beam(elements, deflections);
    for (std::size_t i = 0; i < deflections.size(); ++i) {
      const double w = deflections[i];
      const double rigid_plastic = w < 1.0 ? 1.0 + w * w : 2.0 * w;
      EXPECT_NEAR(loads[i] / rigid_plastic, 1.0, 0.02) << elements << " elements, W / h = " << w;
      EXPECT_NEAR(loads[i] / of_two[i], 1.0, 0.02) << elements << " elements, W / h = " << w;
      worst = std::max(worst, std::abs(loads[i] / rigid_plastic - 1.0));
    }
  }
  scenes::record_figure("worst error in %", 100.0 * worst, 2);
}

}  // namespace
}  // namespace cellcrush

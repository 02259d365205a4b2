// Plastic structures beyond their first yield: a truss that keeps residual forces, and a ring that collapses as a
// linkage. Blind to: hardening, and interaction of axial force with moment, which is small here (AxialForceWithMoment).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

namespace cellcrush::plastic_collapse {
namespace {

using std::numbers::pi;

/// The truss of Prager and Hodge (1951): three equal bars from a node to a ceiling, the outer ones at 45
/// degrees. The bars are slender and pinned to the ceiling; their bending at the node is not felt by symmetry but for
/// the shear of the outer ones, (h / L)^2 of the axial forces.
struct Truss {
  static constexpr double kHeight = 100.0;  // mm, of the middle bar
  static constexpr double kThickness = 2.0;
  static constexpr double kModulus = 200000.0;
  static constexpr double kYieldStress = 100.0;
  static constexpr double kYieldForce = kYieldStress * kThickness;
  // The outer bars are sqrt 2 as long and strain half as much.
  static constexpr double kElasticLimit = kYieldForce * (1.0 + 0.5 * std::numbers::sqrt2);
  static constexpr double kLimit = kYieldForce * (1.0 + std::numbers::sqrt2);

  static SceneSpec spec(const FrameLattice::TimeFunction& load) {
    FrameLattice frame;
    frame.nodes.push_back({0.0, 0.0, 0.0, 0.0});
    for (const double x : {0.0, -kHeight, kHeight}) frame.nodes.push_back({x, kHeight, 0.0, 0.0});
    for (int i = 1; i <= 3; ++i) {
      frame.beams.push_back(scenes::beam(0, i, kThickness, 2));
      frame.supports.push_back({i, true, true, false});
    }
    frame.loads = {{0, FrameLattice::Component::y, load}};
    frame.end_time_s = load.back().first;
    SceneSpec spec = scenes::elastic_frame(std::move(frame));
    spec.material.youngs_modulus_mpa = kModulus;
    spec.material.yield_stress_mpa = kYieldStress;
    spec.material.density_kg_per_m3 = 7850.0;
    spec.numerics.mass_damping_per_s = 0.3 * frequency();
    spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
    return spec;
  }
  static double frequency() { return std::sqrt(kModulus / 7.85e-9) / kHeight; }
};

/// Force in a bar over the yield force; 1 is the middle bar.
double bar_force(const State& state, int bar) {
  return -state.internal_force[bar].y() / Truss::kYieldForce * (bar == 1 ? 1.0 : std::numbers::sqrt2);
}

TEST(Truss, OfThreeBarsKeepsTheResidualForcesOfPragerAndHodge) {
  // Halfway between first yield and collapse. Unloading is elastic: its forces are those of the elastic truss.
  const double unit = 1000.0 / Truss::frequency();
  const double load = 0.5 * (Truss::kElasticLimit + Truss::kLimit);
  const auto scene = scenes::build(Truss::spec({{0.0, 0.0}, {unit, -load}, {2.0 * unit, 0.0}, {2.2 * unit, 0.0}}));
  Simulation simulation(scene);
  simulation.advance(static_cast<std::int64_t>(unit / scene->schedule.time_step));
  const double loaded = load / Truss::kYieldForce;
  const double outer = (loaded - 1.0) / std::numbers::sqrt2;
  EXPECT_NEAR(bar_force(simulation.state(), 1), 1.0, 2e-3);
  EXPECT_NEAR(bar_force(simulation.state(), 2), outer, 5e-3);
  // The deflection is what stretches the outer bars, which are elastic: sqrt 2 of their strain times their length.
  const double yield_way = Truss::kHeight * Truss::kYieldStress / Truss::kModulus;
  EXPECT_NEAR(-simulation.state().position[0].y() / (2.0 * outer * yield_way), 1.0, 5e-3);
  simulation.advance(scene->schedule.step_count);
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  const double middle = bar_force(simulation.state(), 1);
  const double elastic = loaded / (1.0 + 0.5 * std::numbers::sqrt2);  // of the middle bar; the outer ones bear half
  EXPECT_NEAR(middle, 1.0 - elastic, 2e-3);
  EXPECT_NEAR(bar_force(simulation.state(), 2), outer - 0.5 * elastic, 2e-3);
  EXPECT_NEAR(bar_force(simulation.state(), 3), bar_force(simulation.state(), 2), 1e-9);
  scenes::record_figure("residual force of the middle bar", middle, 4);
  scenes::record_figure("residual force of an outer bar", bar_force(simulation.state(), 2), 4);
}

TEST(Truss, OfThreeBarsYieldsFirstAndCollapsesAtTheLoadsOfPragerAndHodge) {
  // The node moves steadily to four times the deflection at first yield.
  const double unit = 3000.0 / Truss::frequency();
  const double yield_way = Truss::kHeight * Truss::kYieldStress / Truss::kModulus;
  SceneSpec spec = Truss::spec({{0.0, 0.0}, {unit, 0.0}});
  spec.loads.loads.clear();
  spec.loads.motions = {{0, FrameLattice::Component::y, {{0.0, 0.0}, {unit, -4.0 * yield_way}}}};
  const auto scene = scenes::build(spec);
  Simulation simulation(scene);
  double first_yield = 0.0;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(1);
    const State& state = simulation.state();
    if (first_yield == 0.0 && state.ledger.plastic > 0.0) first_yield = state.internal_force[0].y();
  }
  const double limit = simulation.state().internal_force[0].y();
  EXPECT_NEAR(first_yield / Truss::kElasticLimit, 1.0, 0.01);
  EXPECT_NEAR(limit / Truss::kLimit, 1.0, 0.005);  // bars of constant volume are 0.2 % thinner by then
  scenes::record_figure("first yield", first_yield / Truss::kElasticLimit, 4);
  scenes::record_figure("collapse load", limit / Truss::kLimit, 4);
}

/// A quarter of a perfectly plastic ring that two opposite forces press together: from its side, which moves along x,
/// to its top, which is moved along y.
struct Ring {
  static constexpr double kRadius = 50.0;  // mm
  static constexpr double kThickness = 3.0;
  static constexpr double kModulus = 200000.0;
  static constexpr double kYieldStress = 60.0;
  static constexpr double kFullMoment = kYieldStress * kThickness * kThickness / 4.0;

  static SceneSpec spec(int elements, double way, double periods) {
    FrameLattice frame;
    for (int i = 0; i <= elements; ++i) {
      const double angle = 0.5 * pi * i / elements;
      frame.nodes.push_back({kRadius * std::cos(angle), kRadius * std::sin(angle), 0.0, 0.0});
      if (i > 0) frame.beams.push_back(scenes::beam(i - 1, i, kThickness, 1));
    }
    frame.supports = {{0, false, true, true}, {elements, true, false, true}};
    // sqrt(36 / 5) sqrt(E I / rho A) / R^2: the ring becomes an oval (Rayleigh 1877).
    const double frequency = 2.683 * std::sqrt(kModulus / 7.85e-9) * kThickness / std::sqrt(12.0) / (kRadius * kRadius);
    const double end = periods * 2.0 * pi / frequency;
    // From rest, by a steady acceleration over the first tenth of the time.
    FrameLattice::TimeFunction points;
    for (int i = 0; i <= 40; ++i) points.emplace_back(i * end / 400.0, -way / 0.95 * i * i / 32000.0);
    points.emplace_back(end, -way);
    frame.motions = {{elements, FrameLattice::Component::y, points}};
    frame.end_time_s = end;
    SceneSpec spec = scenes::elastic_frame(std::move(frame));
    spec.material.youngs_modulus_mpa = kModulus;
    spec.material.yield_stress_mpa = kYieldStress;
    spec.material.density_kg_per_m3 = 7850.0;
    spec.numerics.mass_damping_per_s = 0.01 * frequency;
    spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
    return spec;
  }
};

// Point loads: hinges at the loads and at the sides, and quarters between them that stay as they are. A quarter's
// hinges are sqrt 2 R apart. When the top has come down by w, the sides are x = sqrt(2 R^2 - (R - w)^2) from the line
// of the loads, and P / 2 at that arm turns both hinges: P x = 4 M_p. At first that is 4 M_p / R. DeRuntz and Hodge
// (1963) have the same at first for a ring between plates, whose load then rises; between points it falls.
TEST(Ring, PressedByTwoPointLoadsFoldsAsALinkageOfFourHinges) {
  constexpr int kElements = 12;  // of a quarter
  const auto scene = scenes::build(Ring::spec(kElements, 0.7 * Ring::kRadius, 40.0));
  Simulation simulation(scene);
  const int interval = static_cast<int>(scene->schedule.step_count / 24);
  double load = 0.0;
  double way = 0.0;
  double width = 0.0;
  double worst = 0.0;
  double worst_arm = 0.0;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(1);
    load += 2.0 * simulation.state().internal_force[kElements].y() / interval;
    way += (Ring::kRadius - simulation.state().position[kElements].y()) / interval;
    width += simulation.state().position[0].x() / interval;
    if (simulation.step() % interval != 0) continue;
    if (way > 0.06 * Ring::kRadius) {  // the elastic part of it is 0.015 R
      const double arm = std::sqrt(2.0 * Ring::kRadius * Ring::kRadius - std::pow(Ring::kRadius - way, 2));
      const double ratio = load * arm / (4.0 * Ring::kFullMoment);
      worst = std::max(worst, std::abs(ratio - 1.0));
      if (way > 0.5 * Ring::kRadius) worst_arm = std::max(worst_arm, std::abs(width / arm - 1.0));
    }
    load = way = width = 0.0;
  }
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  EXPECT_LT(worst, 0.015);
  EXPECT_LT(worst_arm, 0.005);
  scenes::record_figure("worst error of the load in %", 100.0 * worst, 2);
  scenes::record_figure("worst error of the width in %", 100.0 * worst_arm, 2);
}

}  // namespace
}  // namespace cellcrush::plastic_collapse

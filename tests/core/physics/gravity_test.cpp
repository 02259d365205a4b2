// Bodies under gravity: a pendulum of any amplitude, and a hanging chain. Blind to: gravity in directions other than
// along y (Invariance turns it), and contact under gravity (Friction).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

namespace cellcrush::gravity {
namespace {

using std::numbers::pi;

/// A stiff bar that is released at an angle from its rest below the pin.
struct Pendulum {
  static constexpr double kLength = 100.0;  // mm
  static constexpr double kThickness = 10.0;
  static constexpr double kGravity = 2e6;  // mm/s^2

  /// Period of a small swing, s: of a bar, or of one whose masses are lumped at the ends of its elements.
  static double small_period(int elements) {
    double moment = 0.0;  // over the mass
    double inertia = kThickness * kThickness / 12.0;
    for (int i = 1; i <= elements; ++i) {
      const double share = (i == elements ? 0.5 : 1.0) / elements;
      const double arm = kLength * i / elements;
      moment += share * arm;
      inertia += share * arm * arm;
    }
    return 2.0 * pi * std::sqrt(inertia / (moment * kGravity));
  }
  static double small_period() {
    const double inertia = kLength * kLength / 3.0 + kThickness * kThickness / 12.0;
    return 2.0 * pi * std::sqrt(inertia / (0.5 * kLength * kGravity));
  }

  /// From the second to the fourth passage of its lowest place.
  static double measured_period(double amplitude, int elements) {
    FrameLattice frame;
    frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {kLength * std::sin(amplitude), -kLength * std::cos(amplitude), 0.0, 0.0}};
    frame.beams = {scenes::beam(0, 1, kThickness, elements)};
    frame.supports = {{0, true, true, false}};
    frame.gravity_y_m_per_s2 = -1e-3 * kGravity;
    frame.end_time_s = 4.0 * small_period();
    SceneSpec spec = scenes::in_double_precision(scenes::elastic_frame(std::move(frame)));
    const auto scene = scenes::build(spec);
    Simulation simulation(scene);
    std::vector<double> passages;
    double before = kLength;
    while (passages.size() < 4 && simulation.status().kind == RunStatus::Kind::running) {
      simulation.advance(1);
      const double now = simulation.state().position[1].x();
      if (now * before < 0.0) {
        passages.push_back(simulation.time() - scene->schedule.time_step * now / (now - before));
      }
      before = now;
    }
    if (passages.size() < 4) return 0.0;
    return passages[3] - passages[1];
  }
};

TEST(Pendulum, HasThePeriodOfTheCompleteEllipticIntegralAtAnyAmplitude) {
  double worst = 0.0;
  double worst_of_bar = 0.0;
  for (const double degrees : {10.0, 60.0, 120.0, 160.0}) {
    const double amplitude = degrees * pi / 180.0;
    // T = T_0 2 K(sin(a / 2)) / pi; K from the arithmetic-geometric mean too (Gauss 1799).
    const double integral = std::comp_ellint_1(std::sin(0.5 * amplitude));
    double arithmetic = 1.0;
    double geometric = std::cos(0.5 * amplitude);
    for (int i = 0; i < 6; ++i) {
      const double mean = 0.5 * (arithmetic + geometric);
      geometric = std::sqrt(arithmetic * geometric);
      arithmetic = mean;
    }
    EXPECT_NEAR(integral, 0.5 * pi / arithmetic, 1e-12);
    constexpr int kElements = 8;
    const double small_period = Pendulum::measured_period(amplitude, kElements) * 0.5 * pi / integral;
    worst = std::max(worst, std::abs(small_period / Pendulum::small_period(kElements) - 1.0));
    worst_of_bar = std::max(worst_of_bar, std::abs(small_period / Pendulum::small_period() - 1.0));
  }
  scenes::record_bound("error of lumped masses", worst, 3e-5);  // its stretch by the centrifugal force is 2e-5
  scenes::record_figure("error of a bar in %", 100.0 * worst_of_bar, 2,
                        {0.0, 0.42});  // lumping adds 1 / 2 n^2 to the inertia
}

/// A slender chain between two pins at equal height that begins as an arc of a circle and comes to rest under gravity.
struct Chain {
  static constexpr double kSpan = 160.0;  // mm
  static constexpr double kLength = 220.0;
  static constexpr double kThickness = 0.005;
  static constexpr double kGravity = 4e8;                            // mm/s^2: tension stretches it by 0.1 %
  static constexpr double kWeight = 2.7e-9 * kThickness * kGravity;  // N/mm
  static constexpr double kStretching = 70000.0 * kThickness;        // EA, N
  static constexpr double kPull = 0.5 * kWeight * kLength;           // N, of half the chain

  /// Point of the elastic catenary (Irvine 1981) at the undeformed length s from the left pin, under the
  /// horizontal tension H; y up.
  static Vector2 point(double tension, double s) {
    const double left = kPull / tension;
    const double here = (kPull - kWeight * s) / tension;
    return {tension * s / kStretching + tension / kWeight * (std::asinh(left) - std::asinh(here)),
            -kWeight * s / kStretching * (kPull / kWeight - 0.5 * s) -
                tension / kWeight * (std::sqrt(1.0 + left * left) - std::sqrt(1.0 + here * here))};
  }

  /// H with which its right end comes to the right pin, N.
  static double tension() {
    double low = 0.01 * kPull;
    double high = 100.0 * kPull;
    for (int i = 0; i < 100; ++i) {
      const double middle = std::sqrt(low * high);
      (point(middle, kLength).x() > kSpan ? high : low) = middle;
    }
    return low;
  }

  static SceneSpec spec(int elements) {
    double half = 1.0;  // angle of the arc: 2 R sin(half) = S, 2 R n sin(half / n) = L
    for (int i = 0; i < 200; ++i) {
      half += 0.5 * (std::sin(half) / (elements * std::sin(half / elements)) - kSpan / kLength);
    }
    const double radius = 0.5 * kSpan / std::sin(half);
    FrameLattice frame;
    for (int i = 0; i <= elements; ++i) {
      const double angle = half * (2.0 * i / elements - 1.0);
      frame.nodes.push_back(
          {0.5 * kSpan + radius * std::sin(angle), radius * (std::cos(half) - std::cos(angle)), 0.0, 0.0});
      if (i > 0) frame.beams.push_back(scenes::beam(i - 1, i, kThickness, 1));
    }
    frame.supports = {{0, true, true, false}, {elements, true, true, false}};
    frame.gravity_y_m_per_s2 = -1e-3 * kGravity;
    const double frequency = std::sqrt(kGravity / kSpan);
    frame.end_time_s = 25.0 / frequency;
    SceneSpec spec = scenes::in_double_precision(scenes::elastic_frame(std::move(frame)));
    spec.numerics.mass_damping_per_s = 1.6 * frequency;
    return spec;
  }
};

TEST(Chain, HangsInTheElasticCatenaryWithItsTension) {
  const double tension = Chain::tension();
  const double sag = -Chain::point(tension, 0.5 * Chain::kLength).y();
  // Inextensible: S / 2 a = asinh(L / 2 a), sag = a (cosh(S / 2 a) - 1). Stretching adds what it stretches.
  const double a = tension / Chain::kWeight;
  EXPECT_NEAR(2.0 * a * std::asinh(0.5 * Chain::kLength / a) / Chain::kSpan, 1.0, 2e-3);
  EXPECT_NEAR(a * (std::cosh(0.5 * Chain::kSpan / a) - 1.0) / sag, 1.0, 5e-3);
  std::vector<double> worst;
  for (const int elements : {10, 20, 40}) {
    const auto scene = scenes::build(Chain::spec(elements));
    Simulation simulation(scene);
    simulation.advance(scene->schedule.step_count);
    const State& state = simulation.state();
    double error = 0.0;
    for (int i = 0; i <= elements; ++i) {
      const double s = Chain::kLength * i / elements;
      error = std::max(error, (state.position[i] - Chain::point(tension, s)).norm() / Chain::kSpan);
    }
    worst.push_back(error);
    // The pins bear half of the last elements themselves.
    const Vector2 force = state.internal_force[0];
    EXPECT_NEAR(-force.y() / (Chain::kPull * (1.0 - 1.0 / elements)), 1.0, 1e-6);
    if (elements < 40) continue;
    EXPECT_LT(error, 1e-3);
    scenes::record_figure("horizontal tension", force.x() / tension, 5, {1.0, 1e-3});
    scenes::record_figure("sag", -state.position[elements / 2].y() / sag, 5, {1.0, 1e-3});
  }
  const double order = std::log2(worst[1] / worst[2]);
  scenes::record_figure("worst error of the shape over the span", worst[2], 2);
  scenes::record_figure("order", order, 3, {2.0, 0.1});
}

}  // namespace
}  // namespace cellcrush::gravity

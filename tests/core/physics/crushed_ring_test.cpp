// A perfectly plastic ring between two rigid plates: DeRuntz and Hodge (1963). Blind to: hardening.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <variant>
#include <vector>

#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/run_frame.h"

namespace cellcrush::crushed_ring {
namespace {

using std::numbers::pi;

/// A whole ring on a rigid wall, which another one presses down on it.
struct Ring {
  static constexpr double kRadius = 50.0;  // mm, mean
  static constexpr double kThickness = 3.0;
  static constexpr double kModulus = 200000.0;
  static constexpr double kYieldStress = 50.0;
  static constexpr double kFullMoment = kYieldStress * kThickness * kThickness / 4.0;  // N mm

  /// `elements` in a quarter; the wall moves by `way` mm in so many periods of the ring.
  static SceneSpec spec(int elements, double way, double periods) {
    FrameLattice frame;
    const int count = 4 * elements;
    for (int i = 0; i < count; ++i) {
      const double angle = 2.0 * pi * i / count;
      frame.nodes.push_back({kRadius * std::cos(angle), kRadius * std::sin(angle), 0.0, 0.0});
      frame.beams.push_back(scenes::beam(i, (i + 1) % count, kThickness, 1));
    }
    frame.supports = {{elements, true, false, false}, {3 * elements, true, false, false}};  // its top and bottom
    // sqrt(36 / 5) sqrt(E I / rho A) / R^2: the ring becomes an oval (Rayleigh 1877).
    const double frequency = 2.683 * std::sqrt(kModulus / 7.85e-9) * kThickness / std::sqrt(12.0) / (kRadius * kRadius);
    const double end = periods * 2.0 * pi / frequency;
    // From rest, by a steady acceleration over the first tenth of the time.
    FrameLattice::TimeFunction points;
    for (int i = 0; i <= 40; ++i) points.emplace_back(i * end / 400.0, way / 0.95 * i * i / 32000.0);
    points.emplace_back(end, way);
    const double face = kRadius + 0.5 * kThickness;
    frame.rigid_walls = {{0.0, -face, 0.0, 1.0, 0.0, {}}, {0.0, face, 0.0, -1.0, 0.0, points}};
    frame.end_time_s = end;
    SceneSpec spec = scenes::elastic_frame(std::move(frame));
    spec.material.youngs_modulus_mpa = kModulus;
    spec.material.yield_stress_mpa = kYieldStress;
    spec.material.density_kg_per_m3 = 7850.0;
    spec.numerics.mass_damping_per_s = 0.01 * frequency;
    spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
    spec.output.sample_count = 40;
    return spec;
  }
};

// Quarters between hinges stay as they are. They turn by theta about the hinges at the sides, and touch the plates
// where their tangents are level: R cos theta from the sides. The plates come together by d = D sin theta with D = 2 R.
// P / 2 at that arm turns two hinges, so P R cos theta = 4 M_p and P = (4 M_p / R) / sqrt(1 - (d / D)^2).
TEST(CrushedRing, BetweenRigidWallsBearsTheRisingLoadOfDeRuntzAndHodge) {
  std::vector<Sample> samples = scenes::run_frame(Ring::spec(48, 0.8 * Ring::kRadius, 100.0));
  samples.pop_back();  // after a shorter interval
  std::vector<double> ratios;
  double worst = 0.0;
  double apart = 0.0;
  for (const Sample& sample : samples) {
    const RigidWallSample& below = sample.rigid_walls.at(0);
    const RigidWallSample& above = sample.rigid_walls.at(1);
    const double share = above.displacement / (2.0 * Ring::kRadius);
    if (share < 0.045) continue;  // 0.015 of it are elastic
    const double exact = 4.0 * Ring::kFullMoment / Ring::kRadius / std::sqrt(1.0 - share * share);
    ratios.push_back(0.5 * (below.normal_force + above.normal_force) / exact);
    worst = std::max(worst, std::abs(ratios.back() - 1.0));
    apart = std::max(apart, std::abs(below.normal_force - above.normal_force) / exact);
  }
  ASSERT_GT(ratios.size(), 30);
  const auto mean_of = [&](std::size_t first, std::size_t count) {
    const auto from = ratios.begin() + static_cast<std::ptrdiff_t>(first);
    return std::accumulate(from, from + static_cast<std::ptrdiff_t>(count), 0.0) / static_cast<double>(count);
  };
  // The ring is a polygon: it touches at corners, which come to the wall one after the other. Hence means.
  const double early = mean_of(0, 5);
  const double late = mean_of(ratios.size() - 5, 5);
  EXPECT_NEAR(early, 1.0, 0.015);
  EXPECT_NEAR(late, 1.0, 0.025);  // without the growth it would be 1.08
  EXPECT_LT(worst, 0.03);
  EXPECT_LT(apart, 0.015);  // both walls bear the same: slow enough
  scenes::record_figure("collapse load", early, 3);
  scenes::record_figure("load at 0.4 D", late, 3);
  scenes::record_bound("worst error in %", 100.0 * worst);
}

// Rounding leaves energies of 1e-20 mJ, whose balance says nothing.
TEST(CrushedRing, IsAtRestUntilAWallReachesIt) {
  SceneSpec spec = Ring::spec(12, 0.5, 1.0);
  auto& frame = std::get<FrameWalls>(spec.lattice);
  for (FrameLattice::Node& node : frame.nodes) {
    node.x_mm = std::round(1e6 * node.x_mm) / 1e6;
    node.y_mm = std::round(1e6 * node.y_mm) / 1e6;
  }
  frame.supports.clear();
  spec.loads.rigid_walls[0].y_mm -= 2.0;
  spec.loads.rigid_walls[1].y_mm += 2.0;
  const std::vector<Sample> samples = scenes::run_frame(spec);
  EXPECT_GT(samples.back().step, 100);
  for (const Sample& sample : samples) {
    EXPECT_LT(sample.energy_kinetic + sample.energy_elastic, 1e-18);
    EXPECT_EQ(sample.rigid_walls.at(1).normal_force, 0.0);
  }
}

}  // namespace
}  // namespace cellcrush::crushed_ring

// Elastic walls whose elements are shorter than they are thick: their forces have a potential (E5c), so that they take
// no energy from bending. Blind to: plastic flow (SlidingArches, SquashedWall) and shear.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "core/reference/elastic_rod.h"
#include "scenes/crushes.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"

namespace cellcrush::short_elements {
namespace {

using Component = FrameLattice::Component;
using std::numbers::pi;

constexpr double kModulus = 300.0;  // MPa
constexpr double kThickness = 1.0;  // mm

SceneSpec rubber(FrameLattice frame) {
  SceneSpec spec = scenes::plastic_frame(std::move(frame), kModulus, 1e9, 1000.0);
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  return spec;
}

// One element, 0.7 of its thickness long, is shortened by 2 % and bent, then led three times round a circle of length
// and turn. With strains over its length it would keep 2 EI / l^2 times the circle's area: 1 % of its moment.
TEST(ShortElasticElements, LedRoundAClosedLoopKeepNothing) {
  constexpr double kLength = 0.7 * kThickness;
  constexpr int kPoints = 64;
  constexpr int kLoops = 3;
  constexpr double kTime = 4e-4;  // s, from point to point
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {kLength, 0.0, 0.0, 0.0}};
  frame.beams = {scenes::beam(0, 1, kThickness, 1)};
  frame.supports = {{0, true, true, false}, {1, false, true, false}};
  FrameLattice::TimeFunction way = {{0.0, 0.0}};
  FrameLattice::TimeFunction turn = {{0.0, 0.0}};
  for (int i = 0; i <= kLoops * kPoints; ++i) {
    const double angle = 2.0 * pi * i / kPoints;
    way.emplace_back((i + 1) * kTime, -kLength * (0.02 + 0.01 * std::sin(angle)));
    turn.emplace_back((i + 1) * kTime, 0.02 + 0.01 * std::cos(angle));
  }
  FrameLattice::TimeFunction back = turn;
  for (auto& [time, value] : back) value = -value;
  frame.motions = {{1, Component::x, way}, {1, Component::rotation, turn}, {0, Component::rotation, back}};
  frame.end_time_s = (kLoops * kPoints + 1) * kTime;
  SceneSpec spec = rubber(std::move(frame));
  spec.numerics.time_step_s = kTime / 1000.0;
  Simulation simulation(scenes::build(spec));
  simulation.advance(1000);
  const double before = simulation.state().internal_moment[1];
  simulation.advance(1000L * kLoops * kPoints);
  EXPECT_GT(std::abs(before), 0.1);
  scenes::record_bound("change of the moment", simulation.state().internal_moment[1] / before - 1.0, 1e-9);
}

/// A clamped strip between ends that are pushed together; a nudge in its middle says to which side it buckles.
struct Strip {
  double length = 0.0;  ///< mm
  int elements = 0;
  static constexpr double kShortened = 0.3;

  [[nodiscard]] double bending() const { return kModulus * std::pow(kThickness, 3) / 12.0; }

  /// The exact force: an elastica with extension, a quarter of which is shot for the moment at the clamp.
  [[nodiscard]] double exact_force() const {
    const double euler = 4.0 * pi * pi * bending() / (length * length);
    const reference::ElasticRod quarter = {0.25 * length, bending(), kModulus * kThickness, 0.0, 0.0};
    const auto end_under = [&](double force, double moment) {
      return quarter.shape_under({-force, 0.0}, moment, Eigen::Vector2d::Zero());
    };
    // The moment with which the quarter ends without one: the greatest at which it still turns over.
    const auto shortened_by = [&](double force) {
      double low = 1e-6 * force * length;
      double high = force * length;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (end_under(force, middle).end_moment < 0.0 ? low : high) = middle;
      }
      return 1.0 - 4.0 * end_under(force, low).end.x() / length;
    };
    double low = 0.9 * euler;
    double high = 3.0 * euler;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (shortened_by(middle) < kShortened ? low : high) = middle;
    }
    return low;
  }

  /// Force of the solver, at rest.
  [[nodiscard]] double force() const {
    FrameLattice frame;
    for (int i = 0; i <= elements; ++i) {
      const double x = length * i / elements;
      frame.nodes.push_back({x, 0.0, 0.0, 0.0});
      if (i > 0) frame.beams.push_back(scenes::beam(i - 1, i, kThickness, 1));
    }
    const double wave_speed = std::sqrt(kModulus / 1e-9);
    const double frequency = 22.4 * wave_speed * kThickness / std::sqrt(12.0) / (length * length);
    const double time = 4.0 * 2.0 * pi / frequency;
    frame.supports = {{0, true, true, true}, {elements, false, true, true}};
    frame.motions = {{elements, Component::x, {{0.0, 0.0}, {time, -kShortened * length}}}};
    frame.initial_velocities = {{elements / 2, 0.0, 1e-5 * length * frequency, 0.0}};  // m/s
    frame.watched_nodes = {0};
    frame.end_time_s = 2.0 * time;
    SceneSpec spec = rubber(std::move(frame));
    spec.numerics.mass_damping_per_s = frequency;
    const std::vector<Sample> samples = scenes::run_frame(spec);
    EXPECT_LT(samples.back().energies.kinetic, 1e-6 * samples.back().energies.elastic);
    return samples.back().watched[0].reaction_x;
  }
};

// The bending strain of the long strips is 0.06, that of the short one 0.5: its elements are a fifth of the thickness.
TEST(ShortElasticElements, OfSqueezedStripsBearTheForceOfTheElastica) {
  double worst = 0.0;
  for (const Strip& strip : {Strip{70.0, 64}, Strip{70.0, 80}, Strip{70.0, 100}, Strip{8.0, 32}, Strip{8.0, 40}}) {
    SCOPED_TRACE(testing::Message() << strip.length << " mm, " << strip.elements << " elements");
    const double error = strip.force() / strip.exact_force() - 1.0;
    EXPECT_LT(std::abs(error), 0.005);
    worst = std::max(worst, std::abs(error));
  }
  scenes::record_bound("error in %", 100.0 * worst, 0.5);
}

// Hexagons so thick that 16 elements are 0.31 of the thickness long, without flow.
TEST(ShortElasticElements, OfASoftLatticeStoreWhatLongerOnesDo) {
  const auto work_with = [](int elements) {
    SceneSpec spec = scenes::spec_of({"hexagon", 20.0, 0.0}, 5, 4);
    scenes::cells_of(spec).wall_thickness_mm = 0.2 * *scenes::cells_of(spec).side_mm;
    spec.material.youngs_modulus_mpa = 5.0;
    spec.material.yield_stress_mpa = 1e6;
    spec.material.density_kg_per_m3 = 1000.0;
    spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
    spec.elements_per_wall = elements;
    spec.loading.end_strain = 0.4;
    Simulation simulation(scenes::build(spec));
    Sample last;
    scenes::watch(simulation, [&](const Sample& sample) { last = sample; });
    EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
    EXPECT_LT(std::abs(last.energies.residual), 0.002 * last.energies.external) << elements;
    return last.energies.external;
  };
  const double fine = work_with(32);
  scenes::record_bound("16 elements: work in %", 100.0 * (work_with(16) / fine - 1.0), 2.0);
  scenes::record_bound("8 elements: work in %", 100.0 * (work_with(8) / fine - 1.0), 4.0);
}

}  // namespace
}  // namespace cellcrush::short_elements

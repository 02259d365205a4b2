#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <variant>
#include <vector>

#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/textbook.h"

// Forces and moments that supports and imposed motions exert on a frame, as samples report them: against statics, and
// against the work of the ledger.
namespace cellcrush::reactions {
namespace {

using scenes::Cantilever;
using Component = FrameLattice::Component;

TEST(Reactions, OfACantileversRootBalanceItsLoad) {
  const double load = Cantilever::kStiffness / (Cantilever::kLength * Cantilever::kLength);  // P L^2 / EI = 1
  SceneSpec spec = Cantilever::spec(8, Component::y, load, 0.2, 1.0);
  std::get<FrameWalls>(spec.lattice).watched_nodes = {0, 1};
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  const std::vector<Sample> samples = scenes::run_frame(spec);
  const WatchedNode& root = samples.back().watched[0];
  const WatchedNode& tip = samples.back().watched[1];
  const double moment = load * (Cantilever::kLength + tip.ux);  // about the root, of the load where it now is
  EXPECT_NEAR(root.reaction_x, 0.0, 1e-6 * load);
  EXPECT_LT(tip.ux, -0.05 * Cantilever::kLength);
  EXPECT_EQ(tip.reaction_y, 0.0);
  scenes::record_bound("force", root.reaction_y / load + 1.0, 1e-6);
  scenes::record_bound("moment", root.reaction_moment / moment + 1.0, 1e-6);
}

TEST(Reactions, OfABeamOnTwoPinsAreHalfOfItsLoadWithoutMoments) {
  SceneSpec spec = Cantilever::spec(8, Component::y, 0.0, 0.2, 1.0);
  auto& frame = std::get<FrameWalls>(spec.lattice);
  constexpr double kLoad = 1e-5;  // N/mm
  frame.supports = {{0, true, true, false}, {1, false, true, false}};
  spec.loads.distributed_loads = {{0, {}, {{0.0, 0.0}, {0.2, -kLoad}}}};
  frame.watched_nodes = {0, 1};
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  const std::vector<Sample> samples = scenes::run_frame(spec);
  const double half = 0.5 * kLoad * Cantilever::kLength;
  for (const WatchedNode& end : samples.back().watched) {
    EXPECT_NEAR(end.reaction_x, 0.0, 1e-5 * half);
    EXPECT_EQ(end.reaction_moment, 0.0);
    scenes::record_bound("force", end.reaction_y / half - 1.0, 1e-5);
  }
}

// A clamped bar that yields as its far end is moved and turned, and let go back halfway.
TEST(Reactions, DoTheWorkOfTheLedgerOverTheMotionsThatAreImposed) {
  FrameLattice frame = scenes::bar(60.0, 1.0, 8);
  frame.supports = {{0, true, true, true}};
  frame.motions = {{1, Component::x, {{0.0, 0.0}, {0.02, -6.0}, {0.03, -4.0}}},
                   {1, Component::y, {{0.0, 0.0}, {0.02, 20.0}, {0.03, 8.0}}},
                   {1, Component::rotation, {{0.0, 0.0}, {0.02, 0.8}, {0.03, 0.2}}}};
  frame.watched_nodes = {0, 1};
  frame.end_time_s = 0.03;
  SceneSpec spec = scenes::elastic_frame(std::move(frame));
  spec.material.yield_stress_mpa = 200.0;
  spec.numerics.mass_damping_per_s = 2000.0;
  spec.output.sample_count = 4000;  // the work below is a sum over samples
  const std::vector<Sample> samples = scenes::run_frame(spec);
  double greatest = 0.0;
  for (const Sample& sample : samples) greatest = std::max(greatest, sample.energies.external);
  double work = 0.0;
  WatchedNode before;
  for (const Sample& sample : samples) {
    const WatchedNode& end = sample.watched[1];
    work += end.reaction_x * (end.ux - before.ux) + end.reaction_y * (end.uy - before.uy) +
            end.reaction_moment * (end.rotation - before.rotation);
    before = end;
    EXPECT_NEAR(work, sample.energies.external, 1e-3 * greatest) << sample.time;
  }
  EXPECT_GT(samples.back().energies.plastic, 0.5 * greatest);
  scenes::record_bound("work in %", 100.0 * (work / samples.back().energies.external - 1.0), 0.2);
}

}  // namespace
}  // namespace cellcrush::reactions

// Beams whose ends are pinned to their nodes: statically determinate forces, the hinge in a mechanism, vibration.
// Blind to: contact at pins, which a case with pins cannot have.
namespace cellcrush::pins {
namespace {

using Component = FrameLattice::Component;

/// Both formulations, single elements and pairs.
std::vector<std::pair<SectionSpec::Formulation, int>> kinds_of_beams() {
  using Formulation = SectionSpec::Formulation;
  return {{Formulation::force_based, 1},
          {Formulation::force_based, 2},
          {Formulation::displacement_based, 1},
          {Formulation::displacement_based, 2}};
}

/// Two stout bars from a wall, whose common end bears a load: one lies, one hangs it up. All ends are pinned to nodes;
/// those at the wall are clamped.
SceneSpec bracket(double load, int elements) {
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {0.0, 60.0, 0.0, 0.0}, {80.0, 0.0, 0.0, 0.0}};
  frame.beams = {scenes::beam(0, 2, 6.0, elements), scenes::beam(1, 2, 6.0, elements)};
  for (FrameLattice::Beam& beam : frame.beams) beam.pin_start = beam.pin_end = true;
  frame.supports = {{0, true, true, true}, {1, true, true, true}};
  frame.loads = {{2, Component::y, {{0.0, 0.0}, {2e-3, -load}}}};
  frame.watched_nodes = {0, 1, 2};
  frame.end_time_s = 8e-3;
  SceneSpec spec = scenes::in_double_precision(scenes::elastic_frame(std::move(frame)));
  spec.numerics.mass_damping_per_s = 2e4;
  return spec;
}

TEST(Pins, OfADeterminateTrussPassTheForcesOfStatics) {
  constexpr double kLoad = 0.3;  // N
  for (const auto& [formulation, elements] : kinds_of_beams()) {
    SceneSpec spec = bracket(kLoad, elements);
    spec.section.formulation = formulation;
    const std::vector<Sample> samples = scenes::run_frame(spec);
    const WatchedNode& low = samples.back().watched[0];
    const WatchedNode& high = samples.back().watched[1];
    EXPECT_NEAR(low.reaction_x, kLoad * 80.0 / 60.0, 1e-5 * kLoad) << elements;
    EXPECT_NEAR(high.reaction_x, -kLoad * 80.0 / 60.0, 1e-5 * kLoad) << elements;
    EXPECT_EQ(low.reaction_moment, 0.0);
    EXPECT_EQ(high.reaction_moment, 0.0);
    scenes::record_bound("force over load", high.reaction_y / kLoad - 1.0, 1e-5);
    scenes::record_bound("force across over load", low.reaction_y / kLoad, 1e-5);
  }
}

// The same bars, welded: their ends pass moments, so that the lower one bears a part of the load across.
TEST(Pins, MakeADifferenceToStoutBars) {
  SceneSpec spec = bracket(0.3, 2);
  for (FrameLattice::Beam& beam : std::get<FrameWalls>(spec.lattice).beams) beam.pin_start = beam.pin_end = false;
  const std::vector<Sample> samples = scenes::run_frame(spec);
  EXPECT_GT(std::abs(samples.back().watched[0].reaction_y), 1e-3 * 0.3);
  EXPECT_NE(samples.back().watched[0].reaction_moment, 0.0);
}

/// A beam between two clamped nodes, pinned to both, or on two simple supports. It is struck across.
SceneSpec simple_beam(bool by_pins, int elements, SectionSpec::Formulation formulation) {
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {40.0, 0.0, 0.0, 0.0}, {80.0, 0.0, 0.0, 0.0}};
  frame.beams = {scenes::beam(0, 1, 1.0, elements), scenes::beam(1, 2, 1.0, elements)};
  frame.beams[0].pin_start = frame.beams[1].pin_end = by_pins;
  frame.supports = {{0, true, true, by_pins}, {2, true, true, by_pins}};
  frame.initial_velocities = {{1, 0.0, 2.0, 0.0}};
  frame.watched_nodes = {1};
  frame.end_time_s = 5e-3;
  SceneSpec spec = scenes::in_double_precision(scenes::elastic_frame(std::move(frame)));
  spec.section.formulation = formulation;
  return spec;
}

TEST(Pins, AtClampedNodesLetABeamVibrateAsSimpleSupportsDo) {
  for (const auto& [formulation, elements] : kinds_of_beams()) {
    const std::vector<Sample> pinned = scenes::run_frame(simple_beam(true, 2 * elements, formulation));
    const std::vector<Sample> simple = scenes::run_frame(simple_beam(false, 2 * elements, formulation));
    ASSERT_EQ(pinned.size(), simple.size());
    double worst = 0.0;
    double greatest = 0.0;
    for (std::size_t i = 0; i < pinned.size(); ++i) {
      worst = std::max(worst, std::abs(pinned[i].watched[0].uy - simple[i].watched[0].uy));
      greatest = std::max(greatest, std::abs(simple[i].watched[0].uy));
    }
    EXPECT_GT(greatest, 0.1);
    EXPECT_LT(std::abs(pinned.back().energies.residual), 1e-3 * pinned.front().energies.kinetic);
    scenes::record_bound("difference over deflection", worst / greatest, 1e-9);
  }
}

// A propped beam: two plastic hinges and the pin make it a mechanism at 6 M_p / L instead of 8.
TEST(Pins, OfAClampedBeamLowerItsLimitLoad) {
  SceneSpec spec = scenes::pushed_clamped_beam(3.0, 12);
  std::get<FrameWalls>(spec.lattice).beams[1].pin_end = true;
  scenes::record_figure("limit load", scenes::expect_limit_load(scenes::run_frame(spec), &WatchedNode::uy, 6.0), 3);
}

// A portal whose left corner is a hinge: hinges at the two feet and the right corner, H = 3 M_p / L instead of 4.
TEST(Pins, OfAPortalsCornerLowerItsLimitLoad) {
  SceneSpec spec = scenes::pushed_portal(8.0, 12);
  std::get<FrameWalls>(spec.lattice).beams[1].pin_start = true;
  scenes::record_figure("limit load", scenes::expect_limit_load(scenes::run_frame(spec), &WatchedNode::ux, 3.0), 3);
}

// Three bars that share a pin: a free triangle and a bar, which flies and spins as one body and keeps its momenta.
TEST(Pins, KeepJointsTogetherToTheLastBitAndMomentumToRoundOff) {
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 2e-4, 0.0}, {30.0, 0.0, 0.0, 0.0}, {10.0, 25.0, 0.0, 0.0}};
  frame.beams = {scenes::beam(0, 1, 1.0, 2), scenes::beam(1, 2, 1.2, 3), scenes::beam(2, 0, 0.8, 2)};
  frame.beams[0].pin_start = frame.beams[2].pin_end = true;  // nothing is welded to node 0
  frame.beams[1].pin_start = true;
  frame.initial_velocities = {{0, 3.0, -1.0, 0.0}, {1, -2.0, 4.0, 0.0}, {2, 1.0, 2.0, 100.0}};
  frame.end_time_s = 5e-3;
  SceneSpec spec = scenes::in_double_precision(scenes::elastic_frame(std::move(frame)));
  const auto scene = scenes::build(spec);
  Simulation simulation(scene);
  const auto [linear, angular] = scenes::momentum_of(*scene, simulation.state());
  double greatest_turn = 0.0;
  Sample sample;
  const State& state = simulation.state();
  const auto check = [&](const Sample& now) {
    sample = now;
    for (std::size_t pin = 0; pin < scene->pins.count(); ++pin) {
      const auto joints = scene->pins.joints_of(pin);
      for (const int joint : joints) {
        EXPECT_EQ(state.position[joint], state.position[joints.front()]);
        greatest_turn = std::max(greatest_turn, std::abs(state.rotation[joint] - state.rotation[joints.front()]));
      }
    }
  };
  scenes::watch(simulation, check, 50);
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  EXPECT_GT(greatest_turn, 0.01);
  const auto [linear_after, angular_after] = scenes::momentum_of(*scene, simulation.state());
  EXPECT_LT((linear_after - linear).norm(), 1e-11 * linear.norm());
  EXPECT_NEAR(angular_after, angular, 1e-10 * std::abs(angular));
  EXPECT_LT(std::abs(sample.energies.residual), 1e-3 * simulation.state().ledger.initial);
  const double mass = std::accumulate(scene->mass.begin(), scene->mass.end(), 0.0);
  EXPECT_NEAR(mass, scene->total_mass + 2e-10, 1e-12 * mass);
}

TEST(Pins, AreRefusedWhereNothingTurns) {
  SceneSpec spec = bracket(0.3, 2);
  spec.loads.loads.push_back({2, Component::rotation, {{0.0, 1.0}}});
  spec.loads.motions = {{2, Component::rotation, {{0.0, 0.0}, {1.0, 1.0}}}};
  const Problems problems = build_scene(spec).problems;
  ASSERT_EQ(problems.size(), 2U);
  EXPECT_EQ(problems[0].field, "lattice.frame.loads[1].component");
  EXPECT_EQ(problems[1].field, "lattice.frame.motions[0].component");
}

}  // namespace
}  // namespace cellcrush::pins

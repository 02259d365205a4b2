#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <variant>
#include <vector>

#include "beam/internal_forces.h"
#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "contact/topology/bands.h"
#include "energy/ledger.h"
#include "motion/initial_state.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

// What particles inside a beam start with: a beam whose two nodes are given a rigid motion is a rigid body.

constexpr double kSpin = 500.0;  // rad/s
constexpr double kLength = 40.0;

/// A free bar at 30 degrees that flies and spins.
SceneSpec spinning_bar(int elements) {
  const Vector2 half(20.0 * std::cos(std::numbers::pi / 6.0), 10.0);
  FrameLattice frame;
  frame.nodes = {{-half.x(), -half.y(), 0.0, 0.0}, {half.x(), half.y(), 0.0, 0.0}};
  frame.beams = {scenes::beam(0, 1, 1.0, elements)};
  for (const int node : {0, 1}) {
    const double side = node == 0 ? -1.0 : 1.0;
    frame.initial_velocities.push_back(
        {node, 3.0 - side * 1e-3 * kSpin * half.y(), -2.0 + side * 1e-3 * kSpin * half.x(), kSpin});
  }
  frame.end_time_s = 2.0 * std::numbers::pi / kSpin;  // one turn
  return scenes::in_double_precision(scenes::elastic_frame(std::move(frame)));
}

TEST(InitialVelocity, OfARigidMotionIsARigidMotionOfTheWholeBeam) {
  for (const int elements : {1, 2, 5, 8}) {
    const auto scene = scenes::build(spinning_bar(elements));
    for (std::size_t i = 0; i < scene->particle_count(); ++i) {
      const Vector2 rigid = Vector2(3000.0, -2000.0) + kSpin * normal_of(scene->position[i]);
      EXPECT_LT((scene->initial_velocity[i] - rigid).norm(), 1e-11 * rigid.norm()) << elements << ", " << i;
      EXPECT_NEAR(scene->initial_spin[i], kSpin, 1e-11 * kSpin) << elements << ", " << i;
    }
  }
}

// A body that spins is stretched by E strain = rho omega^2 (L^2 / 4 - x^2) / 2, and rings about that; nothing else.
TEST(InitialVelocity, ABarThatStartsAsARigidBodyStaysOne) {
  const auto scene = scenes::build(spinning_bar(8));
  Simulation simulation(scene);
  double stored = 0.0;
  double start = 0.0;
  const auto note = [&](const Sample&) {
    const Energies energies = evaluate_energies(*scene, simulation.state());
    stored = std::max(stored, energies.elastic);
    start = energies.initial;
  };
  scenes::watch(simulation, note, 50);
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished);
  // A rod bears rho omega^2 (L^2 / 4 - x^2) / 2; the square of it over 2 E is stored, and four times that when the rod
  // rings about its rest from being unstretched.
  const double rate = scenes::kDensity * 1e-12 * kSpin * kSpin;
  const double at_rest = rate * rate * std::pow(kLength, 5) / (240.0 * 70000.0);
  EXPECT_LT(stored, 4.2 * at_rest);
  EXPECT_GT(stored, at_rest);
  for (const int node : {0, 1}) {
    const Vector2 flown = Vector2(3000.0, -2000.0) * simulation.state().time;
    const double turn = kSpin * simulation.state().time;
    const Vector2& from = scene->position[node];
    const Vector2 place = flown + std::cos(turn) * from + std::sin(turn) * normal_of(from);
    scenes::record_bound("place after a turn over the length",
                         (simulation.state().position[node] - place).norm() / kLength, 1e-4);
  }
  scenes::record_bound("stored energy over that at the start", stored / start);
}

// The cubic of a beam element: turned ends bend it, by L / 8 of the difference of their spins in the middle.
TEST(InitialVelocity, OfTurningEndsBendsTheBeam) {
  SceneSpec spec = spinning_bar(4);
  spec.loads.initial_velocities = {{0, 0.0, 0.0, 7.0}, {1, 0.0, 0.0, -3.0}};
  const auto scene = scenes::build(spec);
  const Vector2 normal(-0.5, 0.5 * std::numbers::sqrt3);
  EXPECT_LT((scene->initial_velocity[3] - kLength / 8.0 * 10.0 * normal).norm(), 1e-11);
  EXPECT_NEAR(scene->initial_spin[3], -(7.0 - 3.0) / 4.0, 1e-12);
}

TEST(InitialVelocity, OfOneNodeLeavesTheRestOfTheBeamAtRest) {
  SceneSpec spec = spinning_bar(4);
  spec.loads.initial_velocities.pop_back();
  const auto scene = scenes::build(spec);
  for (std::size_t i = 1; i < scene->particle_count(); ++i) {
    EXPECT_EQ(scene->initial_velocity[i], Vector2(0.0, 0.0)) << i;
    EXPECT_EQ(scene->initial_spin[i], 0.0) << i;
  }
}

// The motion is imposed, so nothing but the reverse motion can make stress.
TEST(RigidSpin, ThousandTurnsLeaveStressAtRoundOff) {
  const auto scene = scenes::build(scenes::in_double_precision(scenes::hexagon_specimen(3, 2)));
  State state = place_particles(*scene);
  Workers workers(1);
  WallsWorkspace walls;
  std::vector<double> plastic_work(static_cast<std::size_t>(scene->walls.chunk_count()));
  constexpr int kStepsPerTurn = 400;
  constexpr int kTurns = 1000;
  const double turn = 2.0 * std::numbers::pi / kStepsPerTurn;
  const Vector2 centre(5.0, 5.0);
  std::fill(state.spin.begin(), state.spin.end(), turn / scene->schedule.time_step);
  for (int step = 1; step <= kStepsPerTurn * kTurns; ++step) {
    const Vector2 axis = scenes::direction(turn * (step % kStepsPerTurn));
    for (std::size_t i = 0; i < scene->particle_count(); ++i) {
      const Vector2 arm = scene->position[i] - centre;
      state.position[i] = centre + arm.x() * axis + arm.y() * normal_of(axis);
    }
    state.step = step;
    evaluate_internal_forces(*scene, state, whole_band(*scene), walls, workers, plastic_work.data());
  }
  ASSERT_FALSE(state.fibres.stress.empty());
  double greatest = 0.0;
  for (const double stress : state.fibres.stress) greatest = std::max(greatest, std::abs(stress));
  scenes::record_bound("stress over yield stress", greatest / scene->materials.front().yield_stress);
  EXPECT_LT(greatest, 1e-6 * scene->materials.front().yield_stress);
}

}  // namespace
}  // namespace cellcrush

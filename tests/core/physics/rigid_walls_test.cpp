// Rigid walls of frames (E9f): impact of a bar, friction on a slope, momentum, the ledger, turned scenes, checkpoints.
// Blind to: growth of squashed beams at a wall, and contact between beams, which have tests of their own.
#include "scenes/rigid_walls.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "cellcrush/simulation.h"
#include "energy/ledger.h"
#include "scene/approach_speed.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/state_hash.h"

namespace cellcrush::rigid_walls {
namespace {

using scenes::FallingBar;
using scenes::SlopedBlock;
using scenes::TossedFrame;

TEST(RigidWall, BearsAFallingBarWithTheForceOfStVenantForTwoWavePassages) {
  const std::vector<Sample> samples = scenes::run_frame(FallingBar::spec(80));
  double impulse = 0.0;
  double plateau = 0.0;
  int on_plateau = 0;
  double before = 0.0;
  double end_of_force = 0.0;
  for (const Sample& sample : samples) {
    const double force = sample.rigid_walls.at(0).normal_force;
    impulse += force * (sample.time - before);
    const double since = (sample.time - FallingBar::meeting()) / FallingBar::duration();
    if (since > 0.1 && since < 0.9) {
      plateau += force;
      ++on_plateau;
    }
    if (force > 0.5 * FallingBar::force()) end_of_force = since;
    before = sample.time;
    EXPECT_EQ(sample.rigid_walls[0].tangential_force, 0.0);
  }
  const double force = plateau / on_plateau / FallingBar::force();
  const double leaving = impulse / FallingBar::momentum() - 1.0;  // speed over that of the fall
  scenes::record_figure("force", force, 4, {1.0, 2e-3});
  scenes::record_figure("duration", end_of_force, 3, {1.0, 0.03});  // the penalty is as compliant as two elements
  scenes::record_figure("leaving speed", leaving, 3, {1.0, 0.01});
}

TEST(RigidWall, HoldsABlockBelowTheAngleOfFrictionAndLetsItSlideAboveIt) {
  const double critical = std::atan(SlopedBlock::kFriction);
  const SlopedBlock below(0.95 * critical);
  const std::vector<Sample> held = scenes::run_frame(below.spec(1e-2));
  const std::size_t middle = held.size() / 2;
  const double creep = below.way(held.back()) - below.way(held[middle]);
  const RigidWallSample& wall = held.back().rigid_walls[0];
  const double normal = wall.normal_force / below.weight_across() - 1.0;
  const double tangential = wall.tangential_force / below.weight_along() + 1.0;
  scenes::record_bound("creep in mm", creep, 1e-4);
  scenes::record_bound("force of a block at rest", std::max(std::abs(normal), std::abs(tangential)), 1e-6);

  const SlopedBlock above(1.3 * critical);
  const std::vector<Sample> sliding = scenes::run_frame(above.spec(4e-3));
  const double exact = 0.5 * above.acceleration() * std::pow(sliding.back().time, 2);
  scenes::record_bound("way error in %", 100.0 * (above.way(sliding.back()) / exact - 1.0), 1.0);
}

// Exact in the solver: the velocities at half steps change by the forces between them.
TEST(RigidWall, GivesTheFrameItsImpulseAsMomentum) {
  const auto scene = scenes::build(TossedFrame::spec(0.0));
  Simulation simulation(scene);
  const auto along = [&](const Vector2& direction) {
    return scenes::momentum_of(*scene, simulation.state()).linear.dot(direction);
  };
  const RigidWall& wall = scene->rigid_walls.at(0);
  const double normal = along(wall.normal);
  const double tangential = along(wall.tangent());
  simulation.advance(scene->schedule.step_count);
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  const RigidWallTotals impulse = simulation.state().rigid_wall_totals.at(0);
  const double time = simulation.time();
  const double fall = time * scene->total_mass * scene->gravity.dot(wall.normal);
  const double slip = time * scene->total_mass * scene->gravity.dot(wall.tangent());
  EXPECT_GT(impulse.normal, std::abs(normal)) << "the frame must come back";
  EXPECT_LT(impulse.tangential, -0.05 * impulse.normal) << "it must rub";
  const double error = std::max(std::abs(along(wall.normal) - normal - fall - impulse.normal),
                                std::abs(along(wall.tangent()) - tangential - slip - impulse.tangential));
  scenes::record_bound("error over impulse", error / impulse.normal, 1e-9);
}

/// Greatest residual of a run's ledger over the energy turned over: at the start, and by the wall.
double residual_of(const Scene& scene, Simulation& simulation) {
  double worst = 0.0;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(scene.schedule.sample_interval);
    worst = std::max(worst, std::abs(evaluate_energies(scene, simulation.state()).residual));
  }
  const Energies energies = evaluate_energies(scene, simulation.state());
  return worst / (energies.initial + energies.external);
}

TEST(RigidWall, ThatMovesDoesTheWorkThatTheLedgerHas) {
  const auto scene = scenes::build(TossedFrame::spec(0.0));
  Simulation simulation(scene);
  const double residual = residual_of(*scene, simulation);
  const Energies energies = evaluate_energies(*scene, simulation.state());
  // The wall moves steadily: its work is its impulse times its speed. The rest is that of gravity.
  double fall = 0.0;
  for (std::size_t i = 0; i < scene->particle_count(); ++i) {
    fall += scene->mass[i] * scene->gravity.dot(simulation.state().position[i] - scene->position[i]);
  }
  const double of_wall = TossedFrame::kWallSpeed * simulation.state().rigid_wall_totals[0].normal;
  EXPECT_GT(of_wall, 0.1 * energies.initial);
  EXPECT_GT(energies.plastic, 0.1 * energies.initial);
  EXPECT_GT(energies.friction, 0.05 * energies.initial);
  scenes::record_bound("work over impulse times speed", (energies.external - fall) / of_wall - 1.0, 1e-6);
  scenes::record_bound("residual in %", 100.0 * residual, 0.2);  // fibres that begin to yield within a step

  const auto elastic = scenes::build(TossedFrame::spec(0.0, 1e9));
  Simulation bounce(elastic);
  const double elastic_residual = residual_of(*elastic, bounce);
  scenes::record_bound("elastic residual in %", 100.0 * elastic_residual, 0.01);
}

TEST(RigidWall, MayBeTurnedWithItsFrame) {
  constexpr double kAngle = 37.0 * std::numbers::pi / 180.0;
  const std::vector<Sample> plain = scenes::run_frame(TossedFrame::spec(0.0));
  const std::vector<Sample> turned = scenes::run_frame(TossedFrame::spec(kAngle));
  ASSERT_EQ(plain.size(), turned.size());
  const Vector2 x = scenes::direction(kAngle);
  double worst = 0.0;
  double greatest_force = 0.0;
  for (std::size_t s = 0; s < plain.size(); ++s) {
    for (std::size_t i = 0; i < plain[s].watched.size(); ++i) {
      const WatchedNode& node = plain[s].watched[i];
      const Vector2 expected = node.ux * x + node.uy * normal_of(x);
      worst = std::max(worst, (Vector2(turned[s].watched[i].ux, turned[s].watched[i].uy) - expected).norm());
    }
    greatest_force = std::max(greatest_force, plain[s].rigid_walls[0].normal_force);
  }
  double worst_force = 0.0;
  for (std::size_t s = 0; s < plain.size(); ++s) {
    const RigidWallSample& one = plain[s].rigid_walls[0];
    const RigidWallSample& other = turned[s].rigid_walls[0];
    worst_force = std::max({worst_force, std::abs(one.normal_force - other.normal_force) / greatest_force,
                            std::abs(one.tangential_force - other.tangential_force) / greatest_force});
  }
  scenes::record_bound("difference over the side", worst / TossedFrame::kSide, 1e-8);
  scenes::record_bound("difference of the forces", worst_force, 1e-6);
}

TEST(RigidWall, GoesOnFromACheckpointToTheSameBits) {
  const auto scene = scenes::build(TossedFrame::spec(0.3));
  Simulation whole(scene);
  auto pieces = std::make_unique<Simulation>(scene);
  std::vector<double> forces[2];
  for (int piece = 0; piece < 20; ++piece) {
    const std::int64_t steps = scene->schedule.step_count / 20;
    whole.advance(steps);
    const std::string checkpoint = scenes::checkpoint_of(*pieces);
    pieces = std::make_unique<Simulation>(scene);
    ASSERT_TRUE(pieces->restore(source_of(checkpoint)));
    pieces->advance(steps);
    forces[0].push_back(whole.take_sample().rigid_walls.at(0).tangential_force);
    forces[1].push_back(pieces->take_sample().rigid_walls.at(0).tangential_force);
  }
  EXPECT_NE(std::ranges::min(forces[0]), 0.0);
  EXPECT_EQ(forces[0], forces[1]);
  EXPECT_EQ(scenes::hash_of(whole.state()), scenes::hash_of(pieces->state()));
  const std::vector<Sample> samples = {whole.take_sample()};
  const auto read = samples_of(bytes_of(samples));
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->at(0).rigid_walls.at(0).displacement, samples[0].rigid_walls[0].displacement);
}

TEST(RigidWall, CountsInTheSpeedOfApproach) {
  SceneSpec spec = FallingBar::spec(10);
  EXPECT_NEAR(approach_speed_of(*scenes::build(spec)), FallingBar::kSpeed, 1e-9);
  spec.loads.rigid_walls[0].points = {{0.0, 0.0}, {1.0, 300.0}, {2.0, 0.0}};  // towards the bar at 300 mm/s, then away
  EXPECT_NEAR(approach_speed_of(*scenes::build(spec)), FallingBar::kSpeed + 300.0, 1e-9);
  spec.loads.rigid_walls[0].points.clear();
  spec.loads.initial_velocities.clear();
  spec.loads.gravity_x_m_per_s2 = -9.81;
  const double height = FallingBar::kLength + 0.5 * FallingBar::kThickness + FallingBar::kGap;
  EXPECT_NEAR(approach_speed_of(*scenes::build(spec)), std::sqrt(2.0 * 9810.0 * height), 1e-6);
}

}  // namespace
}  // namespace cellcrush::rigid_walls

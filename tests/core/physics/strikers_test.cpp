// Rigid walls with a mass (E9g), gravity, rigid walls and ends of generated lattices: impact on a bar, momentum and the
// ledger on elastic and yielding walls, a mass that comes to rest, light masses, checkpoints. Blind to: friction at a
// mass, which RigidWall has.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "cellcrush/simulation.h"
#include "energy/ledger.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/rigid_walls.h"
#include "scenes/state_hash.h"

namespace cellcrush::strikers {
namespace {

using testing::HasSubstr;

/// A mass runs into the end of a bar, which is longer than a wave comes back in time from.
struct StruckBar {
  static constexpr double kLength = 100.0;  // mm
  static constexpr double kThickness = 1.0;
  static constexpr double kSpeed = 1.0;                                                // m/s
  static constexpr double kMass = 0.5 * 2.7e-9 * kLength * kThickness;                 // tonne, half of the bar's
  static double wave_speed() { return std::sqrt(70000.0 / 2.7e-9); }                   // mm/s
  static double decay_time() { return kMass / (2.7e-9 * kThickness * wave_speed()); }  // s

  static SceneSpec spec(int elements) {
    FrameLattice frame = scenes::bar(kLength, kThickness, elements);
    frame.rigid_walls = {{-0.5 * kThickness, 0.0, 1.0, 0.0}};
    frame.rigid_walls[0].own = {{"mass_g", 1e6 * kMass}, {"speed_m_per_s", kSpeed}};
    frame.end_time_s = 1.9 * kLength / wave_speed();
    SceneSpec spec = scenes::elastic_frame(std::move(frame));
    spec.contact.damping_ratio = 0.0;
    spec.contact.stiffness_factor = 0.25;
    return spec;
  }
};

// St. Venant: the bar is a dashpot, so the mass slows down by exp(-t / T), T = M / (rho A c).
TEST(Striker, IsSlowedDownByABarAsByADashpot) {
  double worst = 0.0;
  for (const Sample& sample : scenes::run_frame(StruckBar::spec(320))) {
    const double exact =
        1e3 * StruckBar::kSpeed * StruckBar::decay_time() * (1.0 - std::exp(-sample.time / StruckBar::decay_time()));
    worst = std::max(worst, std::abs(sample.rigid_walls.at(0).displacement - exact));
  }
  const double way = 1e3 * StruckBar::kSpeed * StruckBar::decay_time();
  scenes::record_bound("way error in %", 100.0 * worst / way, 1.0);
}

/// Of lattice and first rigid wall, tonne.
double mass_of(const Scene& scene) {
  return std::accumulate(scene.mass.begin(), scene.mass.end(), scene.rigid_walls.at(0).mass);
}

/// What a blow on a free lattice under gravity must keep, over its whole time.
struct Kept {
  double momentum_error = 0.0;  // over the momentum of the mass before
  double travel_error = 0.0;    // of the way of the mass from the sum of its speeds, over the way
  double residual = 0.0;        // greatest of the ledger over the energy turned over
  double plastic = 0.0;         // work over the same
  double slowed = 0.0;          // speed of the mass after over that before
};

Kept strike(SceneSpec spec) {
  spec.loads.gravity_y_m_per_s2 = -100.0;
  const auto scene = scenes::build(spec);
  Simulation simulation(scene);
  const double step = scene->schedule.time_step;
  double way = 0.0;
  double residual = 0.0;
  scenes::follow(simulation, [&](const State& state) {
    way += step * state.rigid_wall_motion[0].speed;
    if (state.step % 50 == 0) residual = std::max(residual, std::abs(evaluate_energies(*scene, state).residual));
  });
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  const State& state = simulation.state();
  const RigidWall& wall = scene->rigid_walls.at(0);
  const RigidWallMotion& motion = state.rigid_wall_motion.at(0);
  EXPECT_GT(state.rigid_wall_totals.at(0).normal, 0.0);
  const double momentum = scenes::momentum_of(*scene, state).linear.y() - wall.mass * motion.speed;
  // Velocities are half a step old, and so is gravity's part.
  const double fall = mass_of(*scene) * scene->gravity.y() * (state.time - 0.5 * step);
  const double start = -wall.mass * wall.speed;
  const Energies end = evaluate_energies(*scene, state);
  const double turned_over = end.initial + std::max(0.0, end.external);
  return {std::abs(momentum - fall - start) / std::abs(start), std::abs(motion.travel - way) / way,
          residual / turned_over, end.plastic / turned_over, motion.speed / wall.speed};
}

SceneSpec struck_by(double share, double speed_m_per_s) {
  SceneSpec spec = scenes::struck_hexagons(1.0, speed_m_per_s);
  spec.loads.rigid_walls[0].own["mass_g"] = share * scenes::mass_in_grams(spec);
  return spec;
}

TEST(Striker, KeepsMomentumAndEnergyWhateverItsMass) {
  Kept worst;
  for (const double share : {0.02, 0.3, 5.0}) {
    SceneSpec spec = struck_by(share, 10.0);
    spec.material.yield_stress_mpa = 1e9;
    const Kept kept = strike(spec);
    worst.momentum_error = std::max(worst.momentum_error, kept.momentum_error);
    worst.residual = std::max(worst.residual, kept.residual);
    EXPECT_LT(kept.slowed, 0.99) << share;
  }
  scenes::record_bound("momentum error", worst.momentum_error, 1e-9);
  scenes::record_bound("residual in %", 100.0 * worst.residual, 0.1);
}

// A fibre that crosses into yielding within a step dissipates too much, by the square of the step (E10). An error of
// half a step or of a sign in the motion, the work or the energy of the mass would be of first order or stay: halving
// the step would divide the residual by 2 or 1 instead of 4.
TEST(Striker, KeepsThemOnYieldingWallsByTheSquareOfTheStep) {
  Kept worst;
  double coarse = 0.0;
  for (const double share : {0.3, 5.0}) {
    SceneSpec spec = struck_by(share, 5.0);
    const double chosen = scenes::build(spec)->schedule.time_step;
    double before = 0.0;
    for (const double refined : {1.0, 2.0, 4.0}) {
      spec.numerics.time_step_s = chosen / refined;
      const Kept kept = strike(spec);
      EXPECT_GT(kept.plastic, 0.1) << share;
      if (refined == 1.0) {
        coarse = std::max(coarse, kept.residual);
      } else {
        EXPECT_LT(kept.residual, before / 3.0) << share << " " << refined;
      }
      before = kept.residual;
      worst.momentum_error = std::max(worst.momentum_error, kept.momentum_error);
      worst.travel_error = std::max(worst.travel_error, kept.travel_error);
    }
    worst.residual = std::max(worst.residual, before);
  }
  scenes::record_bound("momentum error", worst.momentum_error, 1e-9);
  scenes::record_bound("way error", worst.travel_error, 1e-9);
  scenes::record_bound("residual in %", 100.0 * coarse, 0.2);
  scenes::record_bound("residual in % at a quarter of the step", 100.0 * worst.residual, 0.01);
}

TEST(Striker, TakesAShorterStepOnlyIfItIsLight) {
  const auto step_for = [](double mass_g) { return scenes::build(scenes::struck_hexagons(mass_g, 1.0))->schedule; };
  const double lattice = scenes::mass_in_grams(scenes::struck_hexagons(1.0, 1.0));
  EXPECT_EQ(step_for(lattice).time_step, step_for(1e3 * lattice).time_step);
  EXPECT_LT(step_for(1e-3 * lattice).time_step, 0.5 * step_for(lattice).time_step);
  EXPECT_EQ(step_for(1e-3 * lattice).bound, StepBound::contacts);
}

TEST(EndAtRest, ComesWhenTheGroundBearsLatticeAndMass) {
  const auto scene = scenes::build(scenes::stopped_mass());
  Simulation simulation(scene);
  scenes::run_to_end(simulation);
  EXPECT_TRUE(simulation.has_ended());
  EXPECT_LT(simulation.step(), scene->schedule.step_count);
  const double weight = -mass_of(*scene) * scene->gravity.y();
  EXPECT_NEAR(simulation.state().rigid_wall_force.at(1).normal.total() / weight, 1.0, 0.05);
  EXPECT_GT(simulation.state().rigid_wall_motion.at(0).travel, 0.02);
  simulation.advance(100);
  EXPECT_TRUE(simulation.has_ended());
}

TEST(EndAtRest, IsAtTheSameStepWhateverPiecesAndCheckpoints) {
  const auto scene = scenes::build(scenes::stopped_mass());
  Simulation whole(scene);
  whole.advance(scene->schedule.step_count);
  auto pieces = std::make_unique<Simulation>(scene, 2);
  while (!pieces->has_ended()) {
    pieces->advance(scene->schedule.step_count / 7 + 13);
    const std::string checkpoint = scenes::checkpoint_of(*pieces);
    pieces = std::make_unique<Simulation>(scene);
    ASSERT_TRUE(pieces->restore(source_of(checkpoint)));
  }
  EXPECT_EQ(pieces->step(), whole.step());
  EXPECT_EQ(scenes::hash_of(pieces->state()), scenes::hash_of(whole.state()));
}

std::vector<std::string> problems_of(const LoadsSpec::RigidWall& wall) {
  SceneSpec spec = scenes::struck_hexagons(1.0, 1.0);
  spec.loads.rigid_walls = {wall};
  std::vector<std::string> texts;
  for (const Problem& problem : build_scene(spec).problems) {
    texts.push_back(problem.field + " " + problem.value + " " + problem.message + " " + problem.remedy);
  }
  return texts;
}

TEST(Striker, IsCheckedByFieldAndIsAmongTheFacts) {
  using testing::ElementsAre;
  const double high = 1e3;
  EXPECT_THAT(problems_of({0.0, high, 0.0, -1.0, 0.0, {}, {{"mass_g", 0.0}}}),
              ElementsAre(HasSubstr("loading.rigid_walls[0].mass_g 0 is too small.")));
  EXPECT_THAT(problems_of({0.0, high, 0.0, -1.0, 0.0, {}, {{"speed_m_per_s", 3.0}}}),
              ElementsAre(HasSubstr("loading.rigid_walls[0].speed_m_per_s 3 is that of a rigid wall with a mass")));
  EXPECT_THAT(problems_of({0.0, high, 0.0, -1.0, 0.0, {{0.0, 0.0}}, {{"mass_g", 1.0}}}),
              ElementsAre(HasSubstr("loading.rigid_walls[0].displacement_mm")));
  EXPECT_THAT(problems_of({0.0, 1.0, 0.0, -1.0}), ElementsAre(HasSubstr("the depth to which the walls at (")));
  EXPECT_THAT(facts_of(*scenes::build(scenes::struck_hexagons(1.0, 1.0))).modelled,
              testing::Contains(HasSubstr("Rigid walls with a mass: 1 half plane")));
  SceneSpec endless = scenes::struck_hexagons(1.0, 1.0);
  endless.loading.end_time_s.reset();
  ASSERT_EQ(build_scene(endless).problems.size(), 1U);
  EXPECT_EQ(build_scene(endless).problems[0].field, "loading.speed_m_per_s");
}

}  // namespace
}  // namespace cellcrush::strikers

#include <gtest/gtest.h>

#include "cellcrush/state.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

RunStatus run_at(double fraction_of_stable_step, double hardening_modulus = 0.0) {
  SceneSpec spec = scenes::hexagon_specimen(8, 5);
  spec.material.hardening_modulus_mpa = hardening_modulus;
  auto scene = scenes::build(spec);
  scene->schedule.time_step = fraction_of_stable_step * scene->stable_step;
  Simulation simulation(scene);
  for (int i = 0; i < 200 && simulation.status().kind == RunStatus::Kind::running; ++i) {
    simulation.advance(20);
    simulation.take_sample();
  }
  return simulation.status();
}

// Plasticity can hide an unstable step as heat; the ledger tells.
TEST(Diagnosis, AStepBeyondTheLimitEndsWithItsNameItsPlaceAndARemedy) {
  const RunStatus status = run_at(1.3);
  EXPECT_TRUE(status.kind == RunStatus::Kind::energy_balance || status.kind == RunStatus::Kind::diverged);
  EXPECT_NE(status.message.find("at step"), std::string::npos) << status.message;
  EXPECT_NE(status.remedy.find("numerics.time_step_s"), std::string::npos) << status.remedy;
}

// Neither does the plastic work over the mean of both yield surfaces hide it.
TEST(Diagnosis, AStepBeyondTheLimitShowsInHardeningWallsToo) {
  for (const double hardening : {700.0, 7000.0}) {
    const RunStatus status = run_at(1.3, hardening);
    EXPECT_TRUE(status.kind == RunStatus::Kind::energy_balance || status.kind == RunStatus::Kind::diverged)
        << hardening;
    EXPECT_EQ(run_at(0.7, hardening).kind, RunStatus::Kind::finished) << hardening;
  }
}

TEST(Diagnosis, ASoundRunEndsWell) { EXPECT_EQ(run_at(0.7).kind, RunStatus::Kind::finished); }

TEST(Diagnosis, ANonFiniteMotionIsNamedWithItsParticle) {
  auto scene = scenes::build(scenes::hexagon_specimen(4, 3));
  scene->initial_velocity.assign(scene->particle_count(), Vector2::Zero());
  scene->initial_velocity[5].x() = std::numeric_limits<double>::infinity();
  Simulation simulation(scene);
  simulation.advance(10);
  simulation.take_sample();
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::diverged);
  EXPECT_NE(simulation.status().message.find("particle "), std::string::npos);
  const std::int64_t stopped = simulation.step();
  simulation.advance(10);
  EXPECT_EQ(simulation.step(), stopped);
}

}  // namespace
}  // namespace cellcrush

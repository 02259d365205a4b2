#include <gtest/gtest.h>

#include <cmath>

#include "cellcrush/state.h"
#include "energy/ledger.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

Vector2 momentum_of(const Scene& scene, const State& state) {
  Vector2 momentum = Vector2::Zero();
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    momentum += scene.mass[i] * state.velocity[i];
  }
  return momentum;
}

// Theory-free: whatever the material does, the plates' forces are the change of the specimen's momentum and what mass
// damping takes.
TEST(Momentum, DifferenceOfThePlatesForcesIsTheSpecimensMomentumRateToRoundOff) {
  SceneSpec spec = scenes::hexagon_specimen(8, 5);
  spec.numerics.mass_damping_per_s = 2000.0;
  const auto scene = scenes::build(spec);
  State state = make_initial_state(*scene);
  const double step = scene->schedule.time_step;
  double peak = 0.0;
  double worst = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double impact = state.impact_force.total();
    const double support = state.support_force.total();
    const double before = momentum_of(*scene, state).x();
    advance_step(*scene, state, nullptr);
    const double after = momentum_of(*scene, state).x();
    const double damping = scene->mass_damping * 0.5 * (before + after);
    peak = std::max({peak, impact, support});
    worst = std::max(worst, std::abs(impact - support - (after - before) / step - damping));
  }
  scenes::record_bound("imbalance over peak force", worst / peak);
  EXPECT_GT(peak, 100.0);
  EXPECT_LT(worst, 1e-9 * peak);
}

TEST(Energy, LedgerClosesWithinOnePercentOverAWholeCrush) {
  SceneSpec spec = scenes::hexagon_specimen(12, 5);
  spec.numerics.mass_damping_per_s = 500.0;
  spec.numerics.time_step_s = 1e-7;
  const auto scene = scenes::build(spec);
  const SceneFacts facts = facts_of(*scene);
  Simulation simulation(scene);
  std::vector<Sample> samples;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(facts.sample_interval);
    samples.push_back(simulation.take_sample());
  }
  const Sample& last = samples.back();
  EXPECT_NEAR(last.strain, 0.8, 1e-3);
  const double sum = last.energies.kinetic + last.energies.elastic + last.energies.plastic + last.energies.contact +
                     last.energies.friction + last.energy_damping() + last.energies.residual;
  EXPECT_NEAR(sum, last.energies.external, 1e-9 * last.energies.external);
  const double error = summarize(*scene, samples).energy_error_relative;
  scenes::record_bound("residual in %", 100.0 * error);
  EXPECT_LT(error, 0.01);
  EXPECT_GT(last.energies.plastic, 0.2 * last.energies.external);
  EXPECT_GT(last.energies.contact, 0.0);
  EXPECT_GT(last.energy_damping(), last.energies.contact_damping);
}

TEST(Energy, ElasticStructureKeepsItsEnergyToRoundOffOfTheScheme) {
  auto scene = scenes::build(scenes::hexagon_specimen(4, 3));
  scene->materials.front().yield_stress = 1e30;
  scene->plates.present = false;
  scene->contact.present = false;
  scene->schedule.time_step = 0.5 * scene->stable_step;
  scene->schedule.step_count = 20000;
  scenes::stir(*scene, 10.0);
  Simulation simulation(scene);
  simulation.advance(20000);
  const Sample sample = simulation.take_sample();
  const double start = simulation.state().ledger.initial;
  EXPECT_GT(sample.energies.elastic, 0.2 * start);
  EXPECT_NEAR(sample.energies.residual / start, 0.0, 1e-4);
}

}  // namespace
}  // namespace cellcrush

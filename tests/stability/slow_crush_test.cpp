// What makes a slow crush another one than was asked for, and how its result shows it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "cellcrush/state.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

/// A small specimen crushed across its rows, so slowly that both plates feel the same.
SceneSpec slow_specimen() {
  SceneSpec spec = scenes::hexagon_specimen(5, 4);
  spec.loading.direction = LoadingSpec::Direction::y;
  spec.loading.speed_m_per_s = 2.0;
  spec.loading.end_strain = 0.2;
  spec.numerics.mass_damping_per_s = 1000.0;
  spec.imperfection = {0.01, 1};
  return spec;
}

struct Crush {
  std::shared_ptr<Scene> scene;
  std::vector<Sample> samples;
  Summary summary;
};

Crush run(const SceneSpec& spec) {
  Crush crush;
  crush.scene = scenes::build(spec);
  Simulation simulation(crush.scene);
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(crush.scene->schedule.sample_interval);
    crush.samples.push_back(simulation.take_sample());
  }
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  crush.summary = summarize(*crush.scene, crush.samples);
  return crush;
}

/// Difference of the plates' mean stresses, of the mean of both.
double difference_of(const SceneSpec& spec) {
  const Crush crush = run(spec);
  EXPECT_TRUE(crush.summary.quasi_static);
  return crush.summary.quasi_static ? crush.summary.quasi_static->plate_difference : 0.0;
}

// The bar is 5 %: beyond it the crush is no longer quasi-static. The summary has the number, `check` the scaling.
TEST(MassScaling, TurnsASlowCrushIntoADynamicOneAndThePlatesTell) {
  SceneSpec spec = slow_specimen();
  EXPECT_LT(difference_of(spec), 0.05);
  spec.numerics.mass_scaling = 1000.0;
  spec.numerics.rotary_scaling = 3.0;
  EXPECT_GT(difference_of(spec), 0.05);
  const SceneFacts facts = facts_of(*scenes::build(spec));
  EXPECT_TRUE(std::any_of(facts.modelled.begin(), facts.modelled.end(), [](const std::string& sentence) {
    return sentence.find("fictitious, 1000 times") != std::string::npos;
  }));
}

// Damping against the ground bears the cells like a thick oil: the impact plate pushes it, the support plate feels
// less.
TEST(MassDamping, HoldsTheCrushUpAndThePlatesTell) {
  SceneSpec spec = slow_specimen();
  spec.numerics.mass_damping_per_s = 1e5;
  const Crush held = run(spec);
  ASSERT_TRUE(held.summary.quasi_static);
  EXPECT_GT(held.summary.quasi_static->plate_difference, 0.05);
  EXPECT_GT(held.samples.back().energy_damping(), 0.1 * held.samples.back().energies.external);
}

/// Greatest stress at the impact plate up to 1 % of strain, MPa.
double early_peak(double ramp_strain) {
  SceneSpec spec = slow_specimen();
  spec.loading.speed_m_per_s = 10.0;
  spec.loading.end_strain = 0.02;
  spec.loading.ramp_strain = ramp_strain;
  double peak = 0.0;
  for (const Sample& sample : run(spec).samples) {
    peak = std::max(peak, sample.strain < 0.01 ? sample.stress_impact : 0.0);
  }
  return peak;
}

// A plate that is at its speed at once sends a wave ahead that has nothing to do with the cells' strength.
TEST(SuddenStart, SendsAWaveThatARampOfTheSpeedTakesAway) { EXPECT_GT(early_peak(0.0), 2.0 * early_peak(0.01)); }

}  // namespace
}  // namespace cellcrush

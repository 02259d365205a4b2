#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cellcrush/state.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "step/advance_step.h"

namespace cellcrush {
namespace {

/// Whether a stirred elastic structure keeps its motion bounded at a fraction of the stable step.
bool is_stable(Scene scene, double fraction, int steps) {
  scene.materials.front().yield_stress = 1e30;
  scene.contact.present = false;
  scene.plates.present = false;
  scenes::stir(scene, 1e-6);
  scene.schedule.time_step = fraction * scene.stable_step;
  scene.schedule.step_count = steps;
  Simulation simulation(std::make_shared<const Scene>(std::move(scene)));
  simulation.advance(steps);
  double fastest = 0.0;
  for (const Vector2& velocity : simulation.state().velocity) {
    fastest = std::max(fastest, velocity.norm());
  }
  return fastest < 1e-4;  // a hundred times the start; an unstable mode has grown without bound, or to not-a-number
}

/// The least fraction of the stable step, on a grid of 0.0025 over 0.11 from `from` on, at which it is unstable.
double first_unstable(const Scene& scene, int steps, double from = 0.95) {
  for (double fraction = from; fraction < from + 0.11; fraction += 0.0025) {
    if (!is_stable(scene, fraction, steps)) {
      return fraction;
    }
  }
  return 2.0;
}

/// A free beam of one element, or of a pair.
std::shared_ptr<Scene> free_beam(int elements, double length, double thickness, double mass_scaling = 1.0,
                                 double rotary_scaling = 1.0, bool shears = false) {
  FrameLattice frame = scenes::bar(1.0, thickness, elements);
  frame.nodes[1] = {elements * length * 0.6, elements * length * 0.8, 0.0, 0.0};
  SceneSpec spec = scenes::plastic_frame(std::move(frame), 69000.0, 76.0, scenes::kDensity);
  spec.numerics.mass_scaling = mass_scaling;
  spec.numerics.rotary_scaling = rotary_scaling;
  spec.section.shear_deformation = shears;
  return scenes::build(spec);
}

TEST(StableStep, LawHoldsForFictitiousMasses) {
  for (const double rotary : {1.0, 3.0, 10.0}) {
    for (const int elements : {1, 2}) {
      const auto scene = free_beam(elements, 2.0, 0.3464, 4.0, rotary);
      EXPECT_TRUE(is_stable(*scene, 0.99, 5000)) << elements << " elements, rotary " << rotary;
      EXPECT_FALSE(is_stable(*scene, 1.01, 5000)) << elements << " elements, rotary " << rotary;
    }
  }
}

/// The greatest of the least unstable fractions of free beams of several thicknesses; each within 1 % of 1.
double expect_limit_of_law(int elements) {
  double highest = 0.0;
  for (const double thickness : {0.05, 0.3464, 1.0}) {
    const auto scene = free_beam(elements, 2.0, thickness);
    EXPECT_TRUE(is_stable(*scene, 0.99, 5000)) << "h = " << thickness;
    EXPECT_FALSE(is_stable(*scene, 1.01, 5000)) << "h = " << thickness;
    const double limit = first_unstable(*scene, 5000);
    EXPECT_GT(limit, 0.99) << "h = " << thickness;
    EXPECT_LT(limit, 1.01) << "h = " << thickness;
    highest = std::max(highest, limit);
  }
  return highest;
}

TEST(StableStep, FreeElementIsStableAt099AndUnstableAt101OfTheLaw) {
  scenes::record_figure("least unstable fraction", expect_limit_of_law(1), 4);
}

TEST(StableStep, FreePairIsStableAt099AndUnstableAt101OfItsLaw) {
  scenes::record_figure("least unstable fraction", expect_limit_of_law(2), 4);
}

// The law leaves shear out, which softens the mode that governs: of an element by 1 + 12 phi, 12 phi = 3.192 (h/l)^2.
TEST(StableStep, OfElementsThatShearIsLongerThanThatOfTheLaw) {
  const auto element = free_beam(1, 2.0, 1.0, 1.0, 1.0, true);
  const double longer = std::sqrt(1.0 + 2.0 * 1.33 / (5.0 / 6.0) * 0.25);
  const double limit = first_unstable(*element, 5000, longer - 0.05);
  EXPECT_NEAR(limit, longer, 0.01);
  scenes::record_figure("element", limit, 3);
  const auto pair = free_beam(2, 2.0, 1.0, 1.0, 1.0, true);
  EXPECT_TRUE(is_stable(*pair, 1.0, 5000));
  double of_pair = 1.0;
  while (of_pair < 2.0 && is_stable(*pair, of_pair, 5000)) of_pair += 0.01;
  scenes::record_figure("pair", of_pair, 3);
}

// The pair bears its rotary inertia at its ends, where the two-node elements of the same mesh bear half of it.
TEST(StableStep, OfAPairIsNearlyTheTimeOfASoundWaveAlongAnElement) {
  const double sound = 2.0 / std::sqrt(69000.0 / 2.7e-9);
  const double of_element = free_beam(1, 2.0, 0.3464)->stable_step;
  const double of_pair = free_beam(2, 2.0, 0.3464)->stable_step;
  EXPECT_NEAR(of_pair / sound, 0.99, 0.005);
  scenes::record_figure("pair over element", of_pair / of_element, 4, {1.72, 0.005});
}

TEST(StableStep, LatticeTurnsUnstableBetween100And102OfTheLaw) {
  const auto scene = scenes::build(scenes::hexagon_specimen(6, 5));
  const double limit = first_unstable(*scene, 4000);
  scenes::record_figure("least unstable fraction", limit, 4);
  EXPECT_GT(limit, 0.9999);
  EXPECT_LT(limit, 1.02);
}

// Theory-free: whatever the material does, the plates' forces are the change of the specimen's momentum and what mass
// damping takes.
TEST(Momentum, DifferenceOfThePlatesForcesIsTheSpecimensMomentumRateToRoundOff) {
  SceneSpec spec = scenes::hexagon_specimen(8, 5);
  spec.numerics.mass_damping_per_s = 2000.0;
  const auto scene = scenes::build(spec);
  State state = make_initial_state(*scene);
  double peak = 0.0;
  double worst = 0.0;
  for (int i = 0; i < 2000; ++i) {
    const double impact = state.impact_force.total();
    const double support = state.support_force.total();
    const double before = scenes::momentum_of(*scene, state).linear.x();
    advance_step(*scene, state, nullptr);
    const double after = scenes::momentum_of(*scene, state).linear.x();
    const double damping = scene->mass_damping * 0.5 * (before + after);
    peak = std::max({peak, impact, support});
    worst = std::max(worst, std::abs(impact - support - (after - before) / scene->schedule.time_step - damping));
  }
  scenes::record_bound("imbalance over peak force", worst / peak, 1e-9);
  EXPECT_GT(peak, 100.0);
}

TEST(Energy, LedgerClosesWithinOnePercentOverAWholeCrush) {
  SceneSpec spec = scenes::hexagon_specimen(12, 5);
  spec.numerics.mass_damping_per_s = 500.0;
  spec.numerics.time_step_s = 1e-7;
  const std::vector<Sample> samples = scenes::run_frame(spec);
  const Sample& last = samples.back();
  EXPECT_NEAR(last.strain, 0.8, 1e-3);
  const double sum = last.energies.kinetic + last.energies.elastic + last.energies.plastic + last.energies.contact +
                     last.energies.friction + last.energy_damping() + last.energies.residual;
  EXPECT_NEAR(sum, last.energies.external, 1e-9 * last.energies.external);
  const double error = summarize(*scenes::build(spec), samples).energy_error_relative;
  scenes::record_bound("residual in %", 100.0 * error, 1.0);
  EXPECT_GT(last.energies.plastic, 0.2 * last.energies.external);
  EXPECT_GT(last.energies.contact, 0.0);
  EXPECT_GT(last.energy_damping(), last.energies.contact_damping);
}

TEST(Energy, ElasticStructureKeepsItsEnergyToRoundOffOfTheScheme) {
  auto scene = scenes::build(scenes::hexagon_specimen(4, 3));
  scene->materials.front().yield_stress = 1e30;
  scene->plates.present = scene->contact.present = false;
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

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cellcrush/state.h"
#include "scene/time_step.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"

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

/// The least fraction of the stable step, on a grid of 0.0025, at which the structure is unstable.
double first_unstable(const Scene& scene, int steps) {
  for (double fraction = 0.95; fraction < 1.06; fraction += 0.0025) {
    if (!is_stable(scene, fraction, steps)) {
      return fraction;
    }
  }
  return 2.0;
}

/// A free beam of one element, or of a pair.
std::shared_ptr<Scene> free_beam(int elements, double length, double thickness, double mass_scaling = 1.0,
                                 double rotary_scaling = 1.0) {
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {elements * length * 0.6, elements * length * 0.8, 0.0, 0.0}};
  frame.beams = {scenes::beam(0, 1, thickness, elements)};
  frame.end_time_s = 1.0;
  SceneSpec spec;
  scenes::put_frame(frame, spec);
  spec.depth_mm = 4.0;
  spec.material.youngs_modulus_mpa = 69000.0;
  spec.material.yield_stress_mpa = 76.0;
  spec.material.density_kg_per_m3 = 2700.0;
  spec.numerics.mass_scaling = mass_scaling;
  spec.numerics.rotary_scaling = rotary_scaling;
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

// The pair bears its rotary inertia at its ends, where the two-node elements of the same mesh bear half of it.
TEST(StableStep, OfAPairIsNearlyTheTimeOfASoundWaveAlongAnElement) {
  const double sound = 2.0 / std::sqrt(69000.0 / 2.7e-9);
  const double of_element = free_beam(1, 2.0, 0.3464)->stable_step;
  const double of_pair = free_beam(2, 2.0, 0.3464)->stable_step;
  EXPECT_NEAR(of_pair / sound, 0.99, 0.005);
  EXPECT_NEAR(of_pair / of_element, 1.72, 0.005);
  scenes::record_figure("pair over element", of_pair / of_element, 4);
}

TEST(StableStep, LatticeTurnsUnstableBetween100And102OfTheLaw) {
  const auto scene = scenes::build(scenes::hexagon_specimen(6, 5));
  const double limit = first_unstable(*scene, 4000);
  scenes::record_figure("least unstable fraction", limit, 4);
  EXPECT_GT(limit, 0.9999);
  EXPECT_LT(limit, 1.02);
}

TEST(StableStep, TypeIHasTheKnownLimit) {
  const auto scene = scenes::build(scenes::hexagon_specimen(4, 3));
  const MeshSteps steps = steps_of(*scene);
  EXPECT_NEAR(steps.of_elements, 2.27e-7, 0.005e-7);
  EXPECT_LT(steps.of_elements, 0.58 * 2.0 / std::sqrt(69000.0 / 2.7e-9));  // 0.577 l / c, not l / c
  EXPECT_NEAR(steps.stable, 3.91e-7, 0.005e-7);
  EXPECT_EQ(steps.stable, scene->stable_step);
}

}  // namespace
}  // namespace cellcrush

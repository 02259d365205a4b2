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

std::shared_ptr<Scene> free_element(double length, double thickness, double mass_scaling = 1.0,
                                    double rotary_scaling = 1.0) {
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {length * 0.6, length * 0.8, 0.0, 0.0}};
  frame.beams = {scenes::beam(0, 1, thickness, 1)};
  frame.end_time_s = 1.0;
  SceneSpec spec;
  spec.lattice = frame;
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
    const auto scene = free_element(2.0, 0.3464, 4.0, rotary);
    EXPECT_TRUE(is_stable(*scene, 0.99, 5000)) << rotary;
    EXPECT_FALSE(is_stable(*scene, 1.01, 5000)) << rotary;
  }
}

TEST(StableStep, FreeElementIsStableAt099AndUnstableAt101OfTheLaw) {
  double highest = 0.0;
  for (const double thickness : {0.05, 0.3464, 1.0}) {
    const auto scene = free_element(2.0, thickness);
    ASSERT_TRUE(scene);
    EXPECT_TRUE(is_stable(*scene, 0.99, 5000)) << "h = " << thickness;
    EXPECT_FALSE(is_stable(*scene, 1.01, 5000)) << "h = " << thickness;
    const double limit = first_unstable(*scene, 5000);
    EXPECT_GT(limit, 0.99) << "h = " << thickness;
    EXPECT_LT(limit, 1.01) << "h = " << thickness;
    highest = std::max(highest, limit);
  }
  scenes::record_figure("least unstable fraction", highest, 4);
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
  EXPECT_NEAR(scene->stable_step, 2.27e-7, 0.005e-7);
  EXPECT_LT(scene->stable_step, 0.58 * 2.0 / std::sqrt(69000.0 / 2.7e-9));  // 0.577 l / c, not l / c
}

}  // namespace
}  // namespace cellcrush

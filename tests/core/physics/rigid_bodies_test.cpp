#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cellcrush/state.h"
#include "scenes/crushes.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

/// A specimen with stiff cells in its third row of six.
SceneSpec specimen_with_inclusions(Inclusions::Model model) {
  SceneSpec spec = scenes::spec_of({"hexagon", 10.0, 0.1}, 8, 6);
  spec.loading.direction = LoadingSpec::Direction::y;
  spec.inclusions = {{3}, 4.0, model};
  return spec;
}

struct Crush {
  std::shared_ptr<const Scene> scene;
  State state;
  Sample last;
};

Crush crush(SceneSpec spec, double end_strain) {
  spec.loading.end_strain = end_strain;
  const auto scene = scenes::build(spec);
  Simulation simulation(scene);
  const Sample last = scenes::run_to_end(simulation).back();
  return {scene, simulation.state(), last};
}

TEST(RigidBodies, AreTheStiffCellsThatAreJoinedWhoseWallsAreNotDivided) {
  const auto scene = scenes::build(specimen_with_inclusions(Inclusions::Model::rigid));
  const auto meshed = scenes::build(specimen_with_inclusions(Inclusions::Model::meshed));
  ASSERT_EQ(scene->rigid.count(), 1u);
  const int cells = 8;
  const int walls = 5 * cells + 1;
  EXPECT_EQ(scene->rigid.particle_count(), 2 * (2 * cells + 1));
  EXPECT_EQ(static_cast<int>(scene->element_count()) - scene->rigid.first_element, walls);
  EXPECT_EQ(meshed->element_count(), scene->element_count() + walls);
  EXPECT_NEAR(scene->total_mass, meshed->total_mass, 1e-12 * meshed->total_mass);
  SceneSpec spec = specimen_with_inclusions(Inclusions::Model::rigid);
  spec.inclusions.rows = {1, 2, 4, 6};
  EXPECT_EQ(scenes::build(spec)->rigid.count(), 3u);  // the first two rows share joints
}

TEST(RigidBodies, DoNotBoundTheStep) {
  SceneSpec spec = specimen_with_inclusions(Inclusions::Model::rigid);
  spec.elements_per_wall = 10;
  const double with = scenes::build(spec)->stable_step;
  spec.inclusions.model = Inclusions::Model::meshed;
  const double meshed = scenes::build(spec)->stable_step;
  spec.inclusions.rows = {};
  EXPECT_EQ(with, scenes::build(spec)->stable_step);
  EXPECT_LT(meshed, 0.7 * with);
}

TEST(RigidBodies, KeepTheirShapeTheLedgerAndTheMomentum) {
  for (const char* kernel : {"scalar", ""}) {
    ASSERT_TRUE(use_simd_target(kernel));
    const Crush run = crush(specimen_with_inclusions(Inclusions::Model::rigid), 0.5);
    const RigidBodies& rigid = run.scene->rigid;
    double worst = 0.0;
    for (int i = 1; i < rigid.particle_count(); ++i) {
      const double before = (run.scene->position[i] - run.scene->position[0]).norm();
      worst = std::max(worst, std::abs((run.state.position[i] - run.state.position[0]).norm() - before));
    }
    EXPECT_LT(worst, 1e-9) << kernel;
    EXPECT_GT((run.state.rigid_centre[0] - rigid.centre[0]).norm(), 1.0) << kernel;
    EXPECT_LT(std::abs(run.last.energies.residual), 0.01 * run.last.energies.external) << kernel;
    const Vector2 momentum = scenes::momentum_of(*run.scene, run.state).linear;
    const double impulse = run.state.impact_impulse - run.state.support_impulse;
    EXPECT_NEAR(momentum.y(), impulse, 1e-2 * run.state.impact_impulse) << kernel;
  }
  use_simd_target("");
}

TEST(RigidBodies, CrushLikeStiffBeams) {
  const Crush rigid = crush(specimen_with_inclusions(Inclusions::Model::rigid), 0.15);
  const Crush meshed = crush(specimen_with_inclusions(Inclusions::Model::meshed), 0.15);
  EXPECT_NEAR(rigid.last.energies.external, meshed.last.energies.external, 0.02 * meshed.last.energies.external);
}

}  // namespace
}  // namespace cellcrush

#include "scenes/textbook.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cellcrush/simulation.h"
#include "scenes/frames.h"
#include "scenes/textbook_claims.h"

namespace cellcrush {
namespace {

std::vector<Sample> run(const SceneSpec& spec) {
  const auto scene = scenes::build(spec);
  const SceneFacts facts = facts_of(*scene);
  Simulation simulation(scene);
  std::vector<Sample> samples;
  while (simulation.status().kind == RunStatus::Kind::running) {
    simulation.advance(facts.sample_interval);
    samples.push_back(simulation.take_sample());
  }
  EXPECT_EQ(simulation.status().kind, RunStatus::Kind::finished) << simulation.status().message;
  return samples;
}

TEST(Textbook, BentSectionFollowsTheBilinearMomentCurvatureLawAndUnloadsElastically) {
  scenes::expect_moment_curvature_law(run(scenes::bent_cantilever(1.6)), 1.6);
}

TEST(Textbook, CyclesCloseWhenKinematicAndShakeDownWhenIsotropic) {
  scenes::expect_closed_cycles(run(scenes::cycled_bar(0.0, 0.004, 5)), 5);
  scenes::expect_shakedown(run(scenes::cycled_bar(1.0, 0.004, 10)), 10);
}

TEST(Textbook, CantileverClampedBeamAndPortalHaveTheirLimitLoads) {
  const int elements = 12;
  scenes::expect_limit_load(run(scenes::pushed_cantilever(8.0, elements)), &WatchedNode::uy, 1.0);
  scenes::expect_limit_load(run(scenes::pushed_clamped_beam(3.0, elements)), &WatchedNode::uy, 8.0);
  scenes::expect_limit_load(run(scenes::pushed_portal(8.0, elements)), &WatchedNode::ux, 4.0);
}

TEST(Textbook, LeesFrameSnapsThroughAtItsLimitLoad) { scenes::expect_lee_limit(run(scenes::lee_frame(60.0))); }

TEST(Textbook, ColumnRestsAtItsElasticaAngleBeyondTheBucklingLoad) {
  for (const auto& [ratio, degrees] : scenes::kColumnAngles) {
    scenes::expect_end_angle(run(scenes::buckled_column(ratio)), degrees);
  }
}

}  // namespace
}  // namespace cellcrush

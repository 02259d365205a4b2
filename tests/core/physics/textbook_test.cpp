#include "scenes/textbook.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "cellcrush/simulation.h"
#include "scenes/evidence.h"
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
  const auto [moment, slope] = scenes::expect_moment_curvature_law(run(scenes::bent_cantilever(1.6)), 1.6);
  scenes::record_figure("worst moment error in %", 100.0 * moment, 2);
  scenes::record_bound("unloading error", slope);
}

TEST(Textbook, CyclesCloseWhenKinematicAndShakeDownWhenIsotropic) {
  scenes::record_figure("worst cycle in %",
                        100.0 * scenes::expect_closed_cycles(run(scenes::cycled_bar(0.0, 0.004, 5)), 5), 1);
  scenes::record_figure("tenth cycle in %",
                        100.0 * scenes::expect_shakedown(run(scenes::cycled_bar(1.0, 0.004, 10)), 10), 2);
}

TEST(Textbook, CantileverClampedBeamAndPortalHaveTheirLimitLoads) {
  const int elements = 12;
  scenes::record_figure(
      "cantilever", scenes::expect_limit_load(run(scenes::pushed_cantilever(8.0, elements)), &WatchedNode::uy, 1.0), 4);
  scenes::record_figure(
      "clamped beam", scenes::expect_limit_load(run(scenes::pushed_clamped_beam(3.0, elements)), &WatchedNode::uy, 8.0),
      4);
  scenes::record_figure("portal",
                        scenes::expect_limit_load(run(scenes::pushed_portal(8.0, elements)), &WatchedNode::ux, 4.0), 4);
}

TEST(Textbook, LeesFrameSnapsThroughAtItsLimitLoad) {
  const auto [load, deflection] = scenes::expect_lee_limit(run(scenes::lee_frame(60.0)));
  scenes::record_figure("load in N", load, 4);
  scenes::record_figure("deflection in mm", deflection, 4);
}

TEST(Textbook, ColumnRestsAtItsElasticaAngleBeyondTheBucklingLoad) {
  double worst = 0.0;
  for (const auto& [ratio, degrees] : scenes::kColumnAngles) {
    worst = std::max(worst, std::abs(scenes::expect_end_angle(run(scenes::buckled_column(ratio)), degrees)));
  }
  scenes::record_figure("worst error in %", 100.0 * worst, 2);
}

}  // namespace
}  // namespace cellcrush

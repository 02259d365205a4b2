// Forces and moments that supports and imposed motions exert on a frame, as samples report them: against statics, and
// against the work of the ledger.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/run_frame.h"

namespace cellcrush::reactions {
namespace {

using scenes::Cantilever;
using Component = FrameLattice::Component;

TEST(Reactions, OfACantileversRootBalanceItsLoad) {
  const double load = Cantilever::kStiffness / (Cantilever::kLength * Cantilever::kLength);  // P L^2 / EI = 1
  SceneSpec spec = Cantilever::spec(8, Component::y, load, 0.2, 1.0);
  std::get<FrameWalls>(spec.lattice).watched_nodes = {0, 1};
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  const std::vector<Sample> samples = scenes::run_frame(spec);
  const WatchedNode& root = samples.back().watched[0];
  const WatchedNode& tip = samples.back().watched[1];
  const double moment = load * (Cantilever::kLength + tip.ux);  // about the root, of the load where it now is
  EXPECT_NEAR(root.reaction_x, 0.0, 1e-6 * load);
  EXPECT_NEAR(root.reaction_y, -load, 1e-6 * load);
  EXPECT_NEAR(root.reaction_moment, -moment, 1e-6 * moment);
  EXPECT_LT(tip.ux, -0.05 * Cantilever::kLength);
  EXPECT_EQ(tip.reaction_y, 0.0);
  scenes::record_bound("force", root.reaction_y / load + 1.0);
  scenes::record_bound("moment", root.reaction_moment / moment + 1.0);
}

TEST(Reactions, OfABeamOnTwoPinsAreHalfOfItsLoadWithoutMoments) {
  SceneSpec spec = Cantilever::spec(8, Component::y, 0.0, 0.2, 1.0);
  auto& frame = std::get<FrameWalls>(spec.lattice);
  constexpr double kLoad = 1e-5;  // N/mm
  frame.supports = {{0, true, true, false}, {1, false, true, false}};
  spec.loads.distributed_loads = {{0, {}, {{0.0, 0.0}, {0.2, -kLoad}}}};
  frame.watched_nodes = {0, 1};
  spec.numerics.fibre_precision = NumericsSpec::FibrePrecision::double_precision;
  const std::vector<Sample> samples = scenes::run_frame(spec);
  const double half = 0.5 * kLoad * Cantilever::kLength;
  for (const WatchedNode& end : samples.back().watched) {
    EXPECT_NEAR(end.reaction_y, half, 1e-5 * half);
    EXPECT_NEAR(end.reaction_x, 0.0, 1e-5 * half);
    EXPECT_EQ(end.reaction_moment, 0.0);
    scenes::record_bound("force", end.reaction_y / half - 1.0);
  }
}

// A clamped bar that yields as its far end is moved and turned, and let go back halfway.
TEST(Reactions, DoTheWorkOfTheLedgerOverTheMotionsThatAreImposed) {
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {60.0, 0.0, 0.0, 0.0}};
  frame.beams = {scenes::beam(0, 1, 1.0, 8)};
  frame.supports = {{0, true, true, true}};
  frame.motions = {{1, Component::x, {{0.0, 0.0}, {0.02, -6.0}, {0.03, -4.0}}},
                   {1, Component::y, {{0.0, 0.0}, {0.02, 20.0}, {0.03, 8.0}}},
                   {1, Component::rotation, {{0.0, 0.0}, {0.02, 0.8}, {0.03, 0.2}}}};
  frame.watched_nodes = {0, 1};
  frame.end_time_s = 0.03;
  SceneSpec spec = scenes::elastic_frame(std::move(frame));
  spec.material.yield_stress_mpa = 200.0;
  spec.numerics.mass_damping_per_s = 2000.0;
  const std::vector<Sample> samples = scenes::run_frame(spec);
  const double greatest = std::ranges::max(samples, {}, &Sample::work_external).work_external;
  double work = 0.0;
  WatchedNode before;
  for (const Sample& sample : samples) {
    const WatchedNode& end = sample.watched[1];
    work += end.reaction_x * (end.ux - before.ux) + end.reaction_y * (end.uy - before.uy) +
            end.reaction_moment * (end.rotation - before.rotation);
    before = end;
    EXPECT_NEAR(work, sample.work_external, 1e-3 * greatest) << sample.time;
  }
  EXPECT_GT(samples.back().energy_plastic, 0.5 * greatest);
  EXPECT_NEAR(work, samples.back().work_external, 2e-3 * work);
  scenes::record_bound("work in %", 100.0 * (work / samples.back().work_external - 1.0));
}

}  // namespace
}  // namespace cellcrush::reactions

// What a scene without imperfection, or bits that are not repeated, decide by chance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cellcrush/state.h"
#include "scenes/frames.h"
#include "scenes/run_frame.h"
#include "scenes/state_hash.h"

namespace cellcrush {
namespace {

/// A straight elastic column, clamped at both ends, that is shortened by six times its buckling strain within some
/// periods of its buckling; its middle stands aside by `offset` mm.
struct Column {
  static constexpr double kLength = 20.0;  // mm
  double aside = 0.0;                      ///< of its middle in the end, mm

  explicit Column(double offset) {
    constexpr double kPress = 2e-4;  // s
    FrameLattice frame;
    frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {0.5 * kLength, offset, 0.0, 0.0}, {kLength, 0.0, 0.0, 0.0}};
    frame.beams = {scenes::beam(0, 1, 0.2, 4), scenes::beam(1, 2, 0.2, 4)};
    frame.supports = {{0, true, true, true}, {2, false, true, true}};
    frame.end_time_s = kPress;
    frame.motions = {{2, FrameLattice::Component::x, {{0.0, 0.0}, {kPress, -0.002 * kLength}}}};
    frame.watched_nodes = {1};
    aside = std::abs(offset + scenes::run_frame(scenes::elastic_frame(frame)).back().watched.front().uy);
  }
};

// A column that stands exactly straight bears six times its buckling load: no force points aside but round-off. A
// thousandth of its length is enough; lattices get theirs from a seed (Imperfection.IsBoundedSeededAndRepeatable).
TEST(PerfectSymmetry, NeverBucklesAndASmallImperfectionDoes) {
  const Column perfect(0.0);
  const Column imperfect(0.001 * Column::kLength);
  EXPECT_LT(perfect.aside, 1e-6);
  EXPECT_GT(imperfect.aside, 0.2);
}

State crush_with(double amplitude) {
  SceneSpec spec = scenes::hexagon_specimen(12, 6);
  spec.imperfection = {amplitude, 1};
  spec.loading.end_strain = 0.6;
  const auto scene = scenes::build(spec);
  Simulation simulation(scene);
  simulation.advance(scene->schedule.step_count);
  return simulation.state();
}

double greatest_distance(const State& a, const State& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.position.size(); ++i) {
    most = std::max(most, (a.position[i] - b.position[i]).norm());
  }
  return most;
}

// A change of the size of round-off chooses another way to fold: sums in the order in which threads happen to end would
// do the same. Sums in a fixed order give the same bits again.
TEST(RoundOff, ChoosesTheFoldsUnlessSumsHaveAFixedOrder) {
  const State first = crush_with(1e-3);
  const State nearly = crush_with(1e-3 * (1.0 + 1e-12));
  EXPECT_GT(greatest_distance(first, nearly), 0.1);
  EXPECT_EQ(scenes::hash_of(first), scenes::hash_of(crush_with(1e-3)));
}

}  // namespace
}  // namespace cellcrush

// How far a lattice without plates is shortened, estimated before it runs.
#include "scene/shortening.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

#include "scenes/frames.h"
#include "scenes/lattices.h"

namespace cellcrush {
namespace {

/// 8 x 6 hexagons listed as a frame for 10 ms, held along the bottom.
struct StandingFrame {
  StandingFrame() {
    const SceneSpec crush = scenes::hexagon_specimen(8, 6);
    spec = scenes::listed(crush);
    spec.loading.speed_m_per_s.reset();
    spec.loading.end_strain.reset();
    spec.loading.end_time_s = 0.01;
    auto& frame = std::get<FrameWalls>(spec.lattice);
    for (const auto& node : frame.nodes) {
      low = std::min(low, node.y_mm);
      high = std::max(high, node.y_mm);
    }
    for (int i = 0; i < static_cast<int>(frame.nodes.size()); ++i) {
      if (frame.nodes[i].y_mm < low + 1e-6) frame.supports.push_back({i, true, true, true});
      if (frame.nodes[i].y_mm > high - 1e-6) top.push_back(i);
    }
    radius = 0.5 * *scenes::cells_of(crush).wall_thickness_mm;
    height = high - low + 2.0 * radius;
  }

  void press(double force) {
    spec.loads.loads.clear();
    for (const int node : top) spec.loads.loads.push_back({node, LoadsSpec::Component::y, {{0.0, -force}}});
  }

  [[nodiscard]] double shortening() const { return shortening_of(*scenes::build(spec)); }

  SceneSpec spec;
  std::vector<int> top;
  double low = 1e9;    // mm
  double high = -1e9;  // mm
  double radius = 0.0;
  double height = 0.0;
};

TEST(Shortening, OfALatticeAtRestIsNone) { EXPECT_EQ(StandingFrame().shortening(), 0.0); }

TEST(Shortening, ByARigidWallBeginsWhereItMeetsTheLattice) {
  StandingFrame frame;
  constexpr double kGap = 1.0;  // mm
  frame.spec.loads.rigid_walls = {
      {0.0, frame.high + frame.radius + kGap, 0.0, -1.0, 0.0, {{0.0, 0.0}, {0.005, kGap + 0.3 * frame.height}}}};
  EXPECT_NEAR(frame.shortening(), 0.3, 1e-9);
  frame.spec.loading.end_time_s = 0.0025;  // half of the way
  EXPECT_NEAR(frame.shortening(), 0.15 - 0.5 * kGap / frame.height, 1e-3);
}

TEST(Shortening, ByMotionsOfNodesIsTheGreatestOfThem) {
  StandingFrame frame;
  for (const int node : frame.top) {
    frame.spec.loads.motions.push_back(
        {node, LoadsSpec::Component::y, {{0.0, 0.0}, {0.004, -0.25 * frame.height}, {0.008, 0.0}}});
  }
  EXPECT_NEAR(frame.shortening(), 0.25, 1e-9) << "they return, but contacts were made";
}

TEST(Shortening, ByLoadsBeginsWhereTheWallsYield) {
  StandingFrame frame;
  double holds = 0.01;
  double crushes = 1000.0;
  frame.press(holds);
  EXPECT_EQ(frame.shortening(), 0.0);
  frame.press(crushes);
  EXPECT_EQ(frame.shortening(), 1.0);
  while (crushes > 1.01 * holds) {
    const double middle = std::sqrt(holds * crushes);
    frame.press(middle);
    (frame.shortening() == 0.0 ? holds : crushes) = middle;
  }
  // The plastic collapse of hexagons after Gibson and Ashby, over the width of the frame.
  const auto scene = scenes::build(scenes::hexagon_specimen(8, 6));
  const double collapse = scene->collapse_stress * scene->width * scene->depth / static_cast<double>(frame.top.size());
  EXPECT_GT(crushes, 0.3 * collapse);
  EXPECT_LT(crushes, 3.0 * collapse);
}

TEST(Shortening, ByAMassEndsWhereItsEnergyDoes) {
  StandingFrame frame;
  const auto by_mass = [&frame](double speed_m_per_s) {
    frame.spec.loads.rigid_walls = {{0.0, frame.high + 1.001 * frame.radius, 0.0, -1.0}};
    frame.spec.loads.rigid_walls[0].own = {{"mass_g", 10.0}, {"speed_m_per_s", speed_m_per_s}};
    return frame.shortening();
  };
  const double slow = by_mass(0.5);
  EXPECT_GT(slow, 0.0);
  EXPECT_LT(slow, 0.1);
  EXPECT_NEAR(by_mass(1.0), 4.0 * slow, 1e-6);
  EXPECT_EQ(by_mass(200.0), 1.0);
}

}  // namespace
}  // namespace cellcrush

// What is refused of rigid walls of a frame: with field, value and remedy.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "cellcrush/simulation.h"
#include "scenes/frames.h"
#include "scenes/rigid_walls.h"

namespace cellcrush {
namespace {

using testing::HasSubstr;
using Wall = LoadsSpec::RigidWall;

/// The problems of a bar along x, 1 mm thick, from 0 to 100, that has a wall.
Problems problems_of(const Wall& wall, bool pinned = false) {
  SceneSpec spec = scenes::FallingBar::spec(2);
  spec.loads.rigid_walls = {wall};
  std::get<FrameWalls>(spec.lattice).beams[0].pin_start = pinned;
  return build_scene(spec).problems;
}

void expect_problem(const Wall& wall, const std::string& field, const std::string& value, const std::string& message) {
  const Problems problems = problems_of(wall);
  ASSERT_EQ(problems.size(), 1) << field;
  EXPECT_EQ(problems[0].field, "loading.rigid_walls[0]" + field);
  EXPECT_EQ(problems[0].value, value);
  EXPECT_THAT(problems[0].message, HasSubstr(message));
  EXPECT_FALSE(problems[0].remedy.empty());
}

TEST(CheckRigidWalls, AcceptsThemWhereTheyTouchTheFrameOrNot) {
  EXPECT_TRUE(problems_of({-10.0, 5.0, 2.0, 0.0, 0.3, {}}).empty());
  EXPECT_TRUE(problems_of({-0.25, 0.0, 1.0, 0.0, 0.0, {}}).empty());
  EXPECT_TRUE(problems_of({-0.25, 7.0, 1.0, 0.0, 0.0, {{0.0, -1.0}, {1.0, 3.0}}}).empty());
}

TEST(CheckRigidWalls, NamesFieldValueAndRemedy) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  expect_problem({-10.0, 0.0, 0.0, 0.0, 0.0, {}}, ".normal_x", "0", "no direction");
  expect_problem({kInfinite, 0.0, 1.0, 0.0, 0.0, {}}, ".x_mm", "inf", "finite");
  expect_problem({-10.0, 2e9, 1.0, 0.0, 0.0, {}}, ".y_mm", "2e+09", "too large");
  expect_problem({-10.0, 0.0, 1.0, kInfinite, 0.0, {}}, ".normal_y", "inf", "finite");
  expect_problem({-10.0, 0.0, 1.0, 0.0, -0.1, {}}, ".friction", "-0.1", "too small");
  expect_problem({-10.0, 0.0, 1.0, 0.0, 0.0, {{1.0, 0.0}, {1.0, 2.0}}}, ".displacement_mm.points", "",
                 "function of time");
}

TEST(CheckRigidWalls, RefusesAFrameThatStandsInOne) {
  expect_problem({0.0, 0.0, 1.0, 0.0, 0.0, {}}, "", "0.25 mm", "lattice.frame.nodes[0]");
  expect_problem({-10.0, 0.0, -3.0, 0.0, 0.0, {}}, "", "110.25 mm", "lattice.frame.nodes[1]");  // the wrong way round
  expect_problem({-0.25, 0.0, 1.0, 0.0, 0.0, {{0.0, 0.5}, {1.0, 0.0}}}, "", "0.5 mm", "time 0");
}

TEST(CheckRigidWalls, RefusesPinnedEnds) {
  const Problems problems = problems_of({-10.0, 0.0, 1.0, 0.0, 0.0, {}}, true);
  ASSERT_EQ(problems.size(), 1);
  EXPECT_EQ(problems[0].field, "loading.rigid_walls");
  EXPECT_THAT(problems[0].message, HasSubstr("pinned"));
}

TEST(CheckRigidWalls, AreAmongTheFactsOfARun) {
  const auto scene = scenes::build(scenes::TossedFrame::spec(0.0));
  EXPECT_THAT(facts_of(*scene).modelled, testing::Contains(HasSubstr("Rigid walls: 1 half plane, 1 of them moving")));
}

}  // namespace
}  // namespace cellcrush

// Loads on their way between case and spec.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "programs/text_proto.h"
#include "server/problem_fields.h"
#include "server/small_case.h"
#include "translate/case_to_spec.h"
#include "translate/check_case.h"
#include "translate/spec_to_case.h"

namespace cellcrush {
namespace {

using ::testing::ElementsAre;
using testing::fields_of;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(TranslateLoads, LoadsAndEndOfAnyLatticeStandInTheLoading) {
  v1::Case given = testing::small_case();
  given.clear_loading();
  given = testing::with_text(given, R"(loading { end_time_s: 1e-3 end_at_rest: 0.01 gravity_y_m_per_s2: -9.81
    rigid_walls { id: "hammer" x_mm: 0 y_mm: 100 normal_y: -1 mass_g: 3 speed_m_per_s: 2 } })");
  const SceneSpec spec = translate::to_spec(given).spec;
  EXPECT_EQ(spec.loading.end_time_s, 1e-3);
  EXPECT_EQ(spec.loading.end_at_rest, 0.01);
  EXPECT_EQ(spec.loads.gravity_y_m_per_s2, -9.81);
  const std::map<std::string, double> own = {{"mass_g", 3.0}, {"speed_m_per_s", 2.0}};
  EXPECT_EQ(spec.loads.rigid_walls.at(0).own, own);
  const auto check = translate::check_case(given);
  ASSERT_THAT(fields_of(check.response), IsEmpty());
  const v1::Loading& completed = check.response.completed_case().loading();
  EXPECT_EQ(completed.end_time_s(), 1e-3);
  EXPECT_EQ(completed.rigid_walls(0).id(), "hammer");
  EXPECT_EQ(completed.rigid_walls(0).mass_g(), 3.0);
  EXPECT_EQ(translate::to_spec(check.response.completed_case()).spec.loads, spec.loads);
  given.mutable_loading()->mutable_rigid_walls(0)->set_mass_g(0.0);
  EXPECT_THAT(fields_of(translate::check_case(given).response), ElementsAre("loading.rigid_walls[0].mass_g"));
}

TEST(TranslateLoads, SidesAndGripsComeThroughBothWays) {
  v1::Case given = testing::small_case();
  given.mutable_loading()->clear_speed_m_per_s();
  given.mutable_loading()->clear_end_strain();
  given.mutable_loading()->clear_ramp_strain();
  given = testing::with_text(given, R"(loading { end_time_s: 1e-3 sides { kind: RIGID friction: 0.2 }
    grips { id: "jaw" edge: RIGHT line_mm: 3 displacement_x_mm { points { time_s: 0 value: 0 }
                                                                points { time_s: 1 value: 2 } } }
    grips { id: "foot" edge: LEFT } })");
  const SceneSpec spec = translate::to_spec(given).spec;
  EXPECT_EQ(spec.loading.sides, (LoadingSpec::Sides{LoadingSpec::Sides::Kind::rigid, 0.2, false, {}}));
  using Grip = LoadsSpec::Grip;
  const Grip jaw = {Grip::Edge::right, 3.0, Grip::FixedTo::ground, {{0.0, 0.0}, {1.0, 2.0}}, {}};
  EXPECT_EQ(spec.loads.grips, (std::vector{jaw, Grip{}}));
  const v1::Case once = translate::to_case(spec);
  given.mutable_loading()->mutable_grips(1)->clear_id();
  const auto reading = translate::to_spec(given);
  EXPECT_THAT(fields_of(reading.problems), ElementsAre("loading.grips[1].id"));
  EXPECT_EQ(once.loading().grips(0).edge(), v1::Loading::Grip::RIGHT);
  EXPECT_EQ(once.loading().grips(1).fixed_to(), v1::Loading::Grip::GROUND);
  EXPECT_EQ(once.loading().sides().friction(), 0.2);
}

TEST(TranslateLoads, PeriodicSidesComeThroughBothWays) {
  const v1::Case given = testing::with_text(testing::small_case(),
                                            "loading { sides { kind: PERIODIC fixed_width: true period_mm: 12.5 } }");
  const SceneSpec spec = translate::to_spec(given).spec;
  EXPECT_EQ(spec.loading.sides, (LoadingSpec::Sides{LoadingSpec::Sides::Kind::periodic, 0.0, true, 12.5}));
  const v1::Loading::Sides once = translate::to_case(spec).loading().sides();
  EXPECT_EQ(once.kind(), v1::Loading::Sides::PERIODIC);
  EXPECT_TRUE(once.fixed_width());
  EXPECT_EQ(once.period_mm(), 12.5);
}

TEST(TranslateLoads, AGripWithoutEdgeOrWithANameTwiceAndARigidWallNamedAsASideAreProblems) {
  const v1::Case given = testing::with_text(testing::small_case(), R"(loading { sides { kind: RIGID }
    rigid_walls { id: "side_low" x_mm: 0 y_mm: -9 normal_y: 1 }
    grips { id: "jaw" } grips { id: "jaw" edge: LEFT displacement_x_mm {} } })");
  EXPECT_THAT(fields_of(translate::to_spec(given).problems),
              ::testing::UnorderedElementsAre("loading.rigid_walls[0].id", "loading.grips[0].edge",
                                              "loading.grips[1].id", "loading.grips[1].displacement_x_mm.points"));
}

// A wall at an edge has no place of its own, and functions of time of its kind.
TEST(TranslateLoads, WallsAtEdgesAndAThrownLatticeComeThroughBothWays) {
  v1::Case given = testing::small_case();
  given.clear_loading();
  given = testing::with_text(given, R"(loading { end_time_s: 1e-3 velocity_x_m_per_s: 3
    rigid_walls { id: "plate" edge: RIGHT mass_g: 2 pressure_mpa { points { time_s: 0 value: 4 } } }
    rigid_walls { id: "base" edge: TOP velocity_m_per_s { points { time_s: 0 value: 1 } } } })");
  const SceneSpec spec = translate::to_spec(given).spec;
  EXPECT_EQ(spec.loads.velocity_x_m_per_s, 3.0);
  EXPECT_EQ(spec.loads.rigid_walls.at(0).edge, LoadsSpec::Edge::right);
  const std::map<std::string, LoadsSpec::TimeFunction> pressure = {{"pressure_mpa", {{0.0, 4.0}}}};
  EXPECT_EQ(spec.loads.rigid_walls[0].functions, pressure);
  const auto check = translate::check_case(given);
  ASSERT_THAT(fields_of(check.response), IsEmpty());
  EXPECT_EQ(check.response.completed_case().loading().rigid_walls(1).id(), "base");
  EXPECT_FALSE(check.response.completed_case().loading().rigid_walls(1).has_x_mm());
  EXPECT_EQ(translate::to_spec(check.response.completed_case()).spec.loads, spec.loads);
  given.mutable_loading()->mutable_rigid_walls(0)->mutable_pressure_mpa()->clear_points();
  given.mutable_loading()->mutable_rigid_walls(1)->set_edge(static_cast<v1::Loading::Grip::Edge>(9));
  EXPECT_THAT(fields_of(translate::to_spec(given).problems),
              ElementsAre("loading.rigid_walls[0].pressure_mpa.points", "loading.rigid_walls[1].edge"));
}

}  // namespace
}  // namespace cellcrush

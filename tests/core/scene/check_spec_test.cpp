#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "cellcrush/simulation.h"
#include "fields/field_checker.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/presets.h"

namespace cellcrush {
namespace {

const Problem* find(const Problems& problems, const std::string& field) {
  const auto found =
      std::find_if(problems.begin(), problems.end(), [&](const Problem& problem) { return problem.field == field; });
  return found == problems.end() ? nullptr : &*found;
}

TEST(CheckSpec, EveryPresetIsSound) {
  for (const auto& preset : scenes::presets()) {
    EXPECT_TRUE(build_scene(preset.spec).problems.empty()) << preset.name;
  }
}

TEST(FieldChecker, AFieldWithoutLimitsIsAMistakeThatNamesIt) {
  FieldChecker check;
  EXPECT_TRUE(check.within_limits("lattice.frame.nodes[3].x_mm", 1.0));
  EXPECT_THROW(FieldChecker::greatest_of("zzz"), std::logic_error);
  try {
    check.within_limits("lattice.hexagon.rims[2].width_mm", 1.0);
    FAIL() << "was checked";
  } catch (const std::logic_error& error) {
    EXPECT_NE(std::string(error.what()).find("lattice.hexagon.rims.width_mm"), std::string::npos) << error.what();
  }
}

TEST(CheckSpec, EmptyCaseNamesEverythingThatIsMissing) {
  const Problems problems = build_scene({}).problems;
  for (const char* field : {"lattice", "depth_mm", "material.youngs_modulus_mpa", "material.yield_stress_mpa",
                            "material.density_kg_per_m3", "loading.speed_m_per_s"}) {
    const Problem* problem = find(problems, field);
    ASSERT_NE(problem, nullptr) << field;
    EXPECT_FALSE(problem->remedy.empty());
  }
}

TEST(CheckSpec, NamesAllProblemsAtOnceWithTheirValues) {
  SceneSpec spec = scenes::hexagon_specimen(20, 7);
  auto& hexagon = scenes::cells_of(spec);
  hexagon.wall_thickness_mm = -0.1;
  hexagon.own.clear();
  spec.loading.speed_m_per_s = 0.0;
  spec.material.density_kg_per_m3 = std::numeric_limits<double>::quiet_NaN();
  spec.material.isotropic_fraction = -0.5;
  spec.contact.impact_speed_m_per_s = -1.0;
  spec.section.depth_points = 1;
  const Problems problems = build_scene(spec).problems;
  EXPECT_EQ(problems.size(), 6u);
  EXPECT_NE(find(problems, "contact.impact_speed_m_per_s"), nullptr);
  ASSERT_NE(find(problems, "lattice.hexagon.wall_thickness_mm"), nullptr);
  EXPECT_EQ(find(problems, "lattice.hexagon.wall_thickness_mm")->value, "-0.1");
  EXPECT_NE(find(problems, "loading.speed_m_per_s"), nullptr);
  ASSERT_NE(find(problems, "material.density_kg_per_m3"), nullptr);
  EXPECT_NE(find(problems, "material.density_kg_per_m3")->message.find("finite"), std::string::npos);
  EXPECT_NE(find(problems, "material.isotropic_fraction"), nullptr);
  EXPECT_NE(find(problems, "section.depth_points"), nullptr);
}

TEST(CheckSpec, RefusesAFixedStepAboveTheStableOneAndSaysBoth) {
  SceneSpec spec = scenes::hexagon_specimen(20, 7);
  spec.numerics.time_step_s = 4e-7;
  const Problems problems = build_scene(spec).problems;
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].field, "numerics.time_step_s");
  EXPECT_EQ(problems[0].value, "4e-07");
  EXPECT_NE(problems[0].message.find("3.91"), std::string::npos) << problems[0].message;
}

TEST(CheckSpec, ImperfectionAndInclusionsAreBoundedByTheLattice) {
  SceneSpec spec = scenes::hexagon_specimen(20, 7);
  spec.imperfection.amplitude_mm = 0.5;
  spec.imperfection.bow_mm = 0.21;
  spec.inclusions.rows = {0, 3, 8};
  spec.inclusions.thickness_factor = 100.0;
  const Problems problems = build_scene(spec).problems;
  for (const char* field :
       {"lattice.imperfection.amplitude_mm", "lattice.imperfection.bow_mm", "lattice.inclusions.rows[0]",
        "lattice.inclusions.rows[2]", "lattice.inclusions.thickness_factor"}) {
    EXPECT_NE(find(problems, field), nullptr) << field;
  }
  EXPECT_EQ(problems.size(), 5u);
}

TEST(CheckSpec, ABowTakesTwoElementsAndARegularLattice) {
  SceneSpec spec = scenes::hexagon_specimen(20, 7);
  spec.imperfection.bow_mm = 0.01;
  EXPECT_TRUE(build_scene(spec).problems.empty());
  spec.elements_per_wall = 1;
  EXPECT_NE(find(build_scene(spec).problems, "lattice.imperfection.bow_mm"), nullptr);
  SceneSpec frame = scenes::Cantilever::spec(4, FrameLattice::Component::y, 1.0, 0.1, 0.2);
  frame.imperfection.bow_mm = 0.01;
  EXPECT_NE(find(build_scene(frame).problems, "lattice.imperfection.bow_mm"), nullptr);
}

TEST(CheckSpec, RefusesALatticeOfRigidCellsAlone) {
  SceneSpec spec = scenes::hexagon_specimen(8, 3);
  spec.inclusions.rows = {1, 2, 3, 2};
  const Problems problems = build_scene(spec).problems;
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].field, "lattice.inclusions.rows");
  spec.inclusions.model = Inclusions::Model::meshed;
  EXPECT_TRUE(build_scene(spec).problems.empty());
  spec.inclusions = {{1, 3}};
  EXPECT_TRUE(build_scene(spec).problems.empty());
}

TEST(CheckSpec, RefusesAMeshThatNoMachineHolds) {
  SceneSpec spec = scenes::hexagon_specimen(10000, 10000);
  EXPECT_NE(find(build_scene(spec).problems, "lattice.hexagon.columns"), nullptr);
}

TEST(CheckSpec, ChosenStepFollowsStabilityAndSpeed) {
  SceneSpec spec = scenes::hexagon_specimen(20, 7);
  spec.loading.speed_m_per_s = 50.0;
  const auto slow = scenes::build(spec);
  EXPECT_NEAR(slow->schedule.time_step, 0.68 * slow->stable_step, 1e-20);
  spec.loading.speed_m_per_s = 200.0;
  const auto fast = scenes::build(spec);
  EXPECT_NEAR(fast->schedule.time_step, 0.08 * 0.3464 / 2e5, 1e-20);
}

}  // namespace
}  // namespace cellcrush

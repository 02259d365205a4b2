// A listed lattice between two plates, or two rigid walls: what a regular one measures, without being generated.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "cellcrush/simulation.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/rigid_walls.h"

namespace cellcrush {
namespace {

SceneSpec short_crush() {
  SceneSpec spec = scenes::hexagon_specimen(4, 3);
  spec.loading.end_strain = 0.5;
  spec.output.sample_count = 200;
  return spec;
}

Summary summary_of(const SceneSpec& spec) { return summarize(*scenes::build(spec), scenes::run_frame(spec)); }

TEST(ListedLattice, BetweenPlatesMeasuresWhatTheRegularOneDoes) {
  const Summary regular = summary_of(short_crush());
  const Summary frame = summary_of(scenes::listed(short_crush()));
  ASSERT_TRUE(regular.plateau_stress_impact && frame.plateau_stress_impact);
  ASSERT_TRUE(regular.plateau_stress_support && frame.plateau_stress_support);
  EXPECT_EQ(frame.step_count, regular.step_count);
  EXPECT_NEAR(*frame.plateau_stress_impact / *regular.plateau_stress_impact, 1.0, 0.01);
  EXPECT_NEAR(*frame.plateau_stress_support / *regular.plateau_stress_support, 1.0, 0.01);
  EXPECT_EQ(frame.theory.shock, 0.0) << "no closed form is known of it";
}

TEST(ListedLattice, EndsWhereItIsClosedAsTheRegularOneDoes) {
  SceneSpec spec = scenes::hexagon_specimen(4, 3);
  scenes::cells_of(spec).wall_thickness_mm = 0.8;
  spec.imperfection = {};
  spec.loading.end_strain.reset();
  const SceneFacts regular = facts_of(*scenes::build(spec));
  const SceneFacts frame = facts_of(*scenes::build(scenes::listed(spec)));
  EXPECT_EQ(frame.end, RunEnd::closed);
  EXPECT_EQ(frame.step_count, regular.step_count);
  EXPECT_NEAR(frame.valid_to_strain.value_or(0.0), *regular.valid_to_strain, 1e-9);
}

/// That crush, turned by an angle, with a rigid wall in place of each plate.
SceneSpec crush_between_walls(double angle) {
  constexpr double kGap = 1e-6;  // mm
  SceneSpec spec = scenes::listed(short_crush());
  const auto between_plates = scenes::build(spec);
  const Vector2 along = scenes::direction(angle);
  const Vector2 across = normal_of(along);
  for (auto& node : std::get<FrameWalls>(spec.lattice).nodes) {
    const Vector2 place = node.x_mm * along + node.y_mm * across;
    node.x_mm = place.x();
    node.y_mm = place.y();
  }
  const double end = *spec.loading.end_strain * between_plates->length / between_plates->plates.speed;
  const Vector2 low = (between_plates->plates.impact_face - kGap) * along;
  const Vector2 high = (between_plates->plates.support_face + kGap) * along;
  spec.loads.rigid_walls = {
      {high.x(), high.y(), -along.x(), -along.y()},
      {low.x(), low.y(), along.x(), along.y(), 0.0, {{0.0, 0.0}, {end, between_plates->plates.speed * end}}}};
  spec.loading.speed_m_per_s.reset();
  spec.loading.end_strain.reset();
  spec.loading.end_time_s = end;
  return spec;
}

TEST(ListedLattice, BetweenRigidWallsMeasuresWhatItDoesBetweenPlates) {
  const Summary plates = summary_of(scenes::listed(short_crush()));
  for (const double angle : {0.0, 0.5}) {
    const SceneSpec spec = crush_between_walls(angle);
    const std::vector<Sample> samples = scenes::run_frame(spec);
    const Summary walls = summarize(*scenes::build(spec), samples);
    EXPECT_NEAR(samples.back().strain, 0.5, 1e-3);
    EXPECT_NEAR(samples[samples.size() / 2].travel, 0.5 * samples.back().travel, 0.01 * samples.back().travel);
    ASSERT_TRUE(walls.plateau_stress_impact && walls.plateau_stress_support && walls.crush_forces);
    EXPECT_NEAR(*walls.plateau_stress_impact / *plates.plateau_stress_impact, 1.0, 0.02) << angle;
    EXPECT_NEAR(*walls.plateau_stress_support / *plates.plateau_stress_support, 1.0, 0.05) << angle;
    EXPECT_NEAR(walls.crush_forces->specific_energy / plates.crush_forces->specific_energy, 1.0, 0.02) << angle;
    EXPECT_NEAR(walls.crush_forces->stroke / plates.crush_forces->stroke, 1.0, 0.01) << angle;
    EXPECT_NEAR(walls.peak->stress / plates.peak->stress, 1.0, 0.05) << angle;
    EXPECT_NEAR(*walls.poissons_ratio, *plates.poissons_ratio, 0.05) << angle << ", of other rows";
    EXPECT_NEAR(walls.absorbed_energy / plates.absorbed_energy, 1.0, 0.02) << angle;
  }
}

TEST(ListedLattice, HasTheMeasuresOfTheOnlyPairOfWallsOfWhichOneMoves) {
  using Walls = std::vector<LoadsSpec::RigidWall>;
  const LoadsSpec::TimeFunction moves = {{0.0, 0.0}, {1.0, 1.0}};
  const LoadsSpec::RigidWall low = {0.0, -1.0, 0.0, 1.0, 0.0, moves};
  const LoadsSpec::RigidWall high = {5.0, 9.0, 0.01, -3.0};
  LoadsSpec::RigidWall mass = high;
  mass.own = {{"mass_g", 2.0}};
  LoadsSpec::RigidWall askew = high;
  askew.normal_x = 1.0;
  LoadsSpec::RigidWall behind = high;
  behind.y_mm = -2.0;
  const LoadsSpec::RigidWall still = {0.0, -1.0, 0.0, 1.0};
  const LoadsSpec::RigidWall aside = {-4.0, 0.0, 1.0, 0.0, 0.0, moves};
  for (const Walls& walls : {Walls{low, high}, Walls{high, low}, Walls{mass, still}, Walls{low, aside, high}}) {
    EXPECT_TRUE(has_crushing_walls(walls));
  }
  for (const Walls& walls : {Walls{}, Walls{low}, Walls{low, mass}, Walls{still, high}, Walls{low, askew},
                             Walls{low, behind}, Walls{low, high, high}, Walls{low, low, high}}) {
    EXPECT_FALSE(has_crushing_walls(walls));
  }
}

// It has no extent across the crush.
TEST(ListedLattice, OfOneColumnHasTheStressOfItsSection) {
  constexpr double kYield = 76.0;  // MPa
  FrameLattice column = scenes::bar(20.0, 1.0, 8);
  column.supports = {{0, false, true, true}, {1, false, true, true}};
  SceneSpec plates = scenes::plastic_frame(column, 69000.0, kYield, 2700.0);
  plates.loading.end_time_s.reset();
  plates.loading.speed_m_per_s = 0.5;
  plates.loading.ramp_strain = 1e-3;
  plates.loading.end_strain = 0.02;
  SceneSpec walls = scenes::plastic_frame(column, 69000.0, kYield, 2700.0);
  const double end = 0.02 * 20.0 / 500.0;
  walls.loads.rigid_walls = {{-0.500001, 0.0, 1.0, 0.0, 0.0, {{0.0, 0.0}, {end, 0.4}}}, {20.500001, 0.0, -1.0, 0.0}};
  walls.loading.end_time_s = end;
  for (const SceneSpec& spec : {plates, walls}) {
    const Summary summary = summary_of(spec);
    EXPECT_EQ(scenes::build(spec)->width, 1.0);
    ASSERT_TRUE(summary.peak && summary.crush_forces);
    // It yields at a strain of 0.0011, within the window of the peak, and buckles later.
    EXPECT_NEAR(summary.peak->stress, 0.94 * kYield, 0.05 * kYield);
    EXPECT_NEAR(summary.crush_forces->peak, *spec.depth_mm * summary.peak->stress, 1e-9);
    EXPECT_GT(summary.crush_forces->mean, 0.5 * summary.crush_forces->peak);
    EXPECT_LT(summary.crush_forces->mean, summary.crush_forces->peak);
  }
}

// Until it rebounds, the mass gives its energy to the lattice.
TEST(ListedLattice, StruckByAMassTakesItsEnergyUpToTheGreatestStrain) {
  constexpr double kSpeed = 20.0;  // m/s
  SceneSpec spec = scenes::struck_hexagons(1.0, kSpeed);
  spec.loads.rigid_walls.push_back({0.0, -0.5001 * *scenes::cells_of(spec).wall_thickness_mm, 0.0, 1.0});
  spec.output.sample_count = 500;
  const std::vector<Sample> samples = scenes::run_frame(spec);
  const Summary summary = summarize(*scenes::build(spec), samples);
  const auto deepest = std::ranges::max_element(samples, {}, &Sample::strain);
  EXPECT_GT(deepest->strain, 0.1);
  EXPECT_LT(samples.back().strain, 0.95 * deepest->strain) << "it must rebound";
  ASSERT_TRUE(summary.crush_forces);
  EXPECT_NEAR(summary.crush_forces->stroke, deepest->travel, 1e-9);
  const double energy = 0.5e-6 * std::pow(1e3 * kSpeed, 2.0);  // N mm
  EXPECT_NEAR(summary.crush_forces->mean * summary.crush_forces->stroke / energy, 1.0, 0.01);
}

TEST(ListedLattice, WithoutCellsHasStressAndStrain) {
  FrameLattice frame;
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {10.0, 0.5, 0.0, 0.0}, {20.0, 0.0, 0.0, 0.0}};
  frame.beams = {scenes::beam(0, 1, 0.5, 4), scenes::beam(1, 2, 0.5, 4)};
  frame.supports = {{0, false, true, true}, {2, false, true, true}};
  SceneSpec spec = scenes::elastic_frame(frame);
  spec.loading.end_time_s.reset();
  spec.loading.speed_m_per_s = 1.0;
  spec.loading.end_strain = 0.02;
  spec.output.sample_count = 50;
  const std::vector<Sample> samples = scenes::run_frame(spec);
  EXPECT_NEAR(samples.back().strain, 0.02, 1e-4);
  EXPECT_GT(samples.back().stress_impact, 0.0);
  EXPECT_FALSE(samples.back().front.has_value());

  spec.loading.end_time_s = 1e-4;  // before the end strain
  EXPECT_NEAR(scenes::run_frame(spec).back().time, 1e-4, 1e-6);
}

TEST(ListedLattice, BetweenPlatesIsRefusedWithAField) {
  const auto fields_of = [](const SceneSpec& spec) {
    std::string fields;
    for (const Problem& problem : build_scene(spec).problems) fields += problem.field + ' ';
    return fields;
  };
  SceneSpec spec = scenes::listed(short_crush());
  auto& frame = std::get<FrameWalls>(spec.lattice);
  spec.loading.speed_m_per_s.reset();
  EXPECT_EQ(fields_of(spec), "loading.end_time_s ");
  spec.loading.speed_m_per_s = 1.0;
  frame = {};
  frame.nodes = {{0.0, 0.0, 0.0, 0.0}, {10.0, 0.0, 0.0, 0.0}};
  frame.beams = {scenes::beam(0, 1, 0.5, 2)};
  spec.loading.direction = LoadingSpec::Direction::y;
  EXPECT_EQ(fields_of(spec), "lattice.frame.nodes ");
}

}  // namespace
}  // namespace cellcrush

// A listed lattice between two plates: what a regular one measures, without being generated.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "cellcrush/simulation.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"

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

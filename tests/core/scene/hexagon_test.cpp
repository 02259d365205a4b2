#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "cellcrush/presets.h"
#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "scene/lattices.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

TEST(TypeI, HasExactlyTheParticlesElementsAndMassOfThePaper) {
  const auto scene = scenes::build(find_preset("type-i")->spec);
  ASSERT_TRUE(scene);
  const SceneFacts facts = facts_of(*scene);
  EXPECT_EQ(facts.particle_count, 8099);
  EXPECT_EQ(facts.element_count, 9642);
  EXPECT_NEAR(facts.mass * 1e6, 4821 * 4.0 * 0.3464 * 4.0 * 2700e-6, 1e-9);  // grams
  EXPECT_NEAR(facts.mass * 1e6, 72.15, 0.01);
  EXPECT_NEAR(facts.length, 512.7, 0.05);
  EXPECT_NEAR(facts.width, 128.0, 1e-9);
  EXPECT_NEAR(scene->stable_step, 3.91e-7, 0.01e-7);
  SceneSpec fixed = find_preset("type-i")->spec;
  fixed.numerics.time_step_s = 2e-7;
  EXPECT_NEAR(static_cast<double>(facts_of(*scenes::build(fixed)).step_count), 20500.0, 20.0);
  EXPECT_EQ(scene->section.section_count(), 4u);
  EXPECT_EQ(scene->section.depth_count(), 6u);
}

TEST(Hexagons, AreAPlanarLatticeOfEqualWalls) {
  HexagonLattice lattice;
  lattice.columns = 9;
  lattice.rows = 6;
  lattice.side_mm = 3.0;
  lattice.wall_thickness_mm = 0.2;
  lattice.vertical_wall_thickness_mm = 0.4;
  SceneSpec spec;
  spec.lattice = lattice;
  spec.elements_per_wall = 2;
  const Layout layout = lay_out_cells(spec);
  const int cells = 3 * 9 + 3 * 8;
  EXPECT_EQ(static_cast<int>(layout.joints.size()) - static_cast<int>(layout.walls.size()) + cells, 1);  // Euler
  std::map<int, int> degree;
  for (const LayoutWall& wall : layout.walls) {
    const Vector2 span = layout.joints[wall.end] - layout.joints[wall.start];
    EXPECT_NEAR(span.norm(), 3.0, 1e-12);
    EXPECT_EQ(wall.thickness, std::abs(span.x()) < 1e-9 ? 0.4 : 0.2);
    ++degree[wall.start];
    ++degree[wall.end];
  }
  for (const auto& [joint, walls] : degree) {
    EXPECT_TRUE(walls == 2 || walls == 3) << "joint " << joint;
  }
  const Vector2 envelope = envelope_of(spec);
  for (const Vector2& joint : layout.joints) {
    EXPECT_TRUE((joint.array() > -1e-9).all() && (joint.array() < envelope.array() + 1e-9).all());
  }
}

TEST(Hexagons, CrushAlongYTurnsLengthAndWidth) {
  SceneSpec spec = scenes::hexagon_specimen(5, 4);
  spec.loading.direction = LoadingSpec::Direction::y;
  const auto scene = scenes::build(spec);
  ASSERT_TRUE(scene);
  EXPECT_NEAR(scene->length, 26.0, 1e-9);
  EXPECT_NEAR(scene->width, 5.0 * 4.0 * std::sqrt(3.0), 1e-9);
  EXPECT_EQ(scene->plates.axis, 1);
}

TEST(Hexagons, ElementsAWallDivideEveryWall) {
  SceneSpec spec = scenes::hexagon_specimen(4, 3);
  const auto two = scenes::build(spec);
  spec.elements_per_wall = 5;
  spec.numerics.time_step_s = 0.0;
  const auto five = scenes::build(spec);
  ASSERT_TRUE(two && five);
  EXPECT_EQ(five->element_count(), two->element_count() / 2 * 5);
  EXPECT_NEAR(five->total_mass, two->total_mass, 1e-15);
}

}  // namespace
}  // namespace cellcrush

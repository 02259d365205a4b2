#include "scene/lattices.h"

#include <gtest/gtest.h>

#include <cmath>

#include "cellcrush/presets.h"
#include "cellcrush/scene.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

TEST(Presets, HaveExactlyTheParticlesOfThePaper) {
  const std::pair<const char*, std::int64_t> counts[] = {{"type-i", 8099},
                                                         {"type-ii-as-stated", 12609},
                                                         {"type-ii-as-counted", 4125},
                                                         {"type-iii-as-stated", 19200},
                                                         {"type-iii-as-counted", 6364},
                                                         {"papka-kyriakides-1", 814},
                                                         {"papka-kyriakides-2", 814}};
  for (const auto& [name, particles] : counts) {
    SceneSpec spec = find_preset(name)->spec;
    spec.elements_per_wall = 2;  // as in the paper
    const auto scene = scenes::build(spec);
    ASSERT_TRUE(scene) << name;
    EXPECT_EQ(facts_of(*scene).particle_count, particles) << name;
  }
}

TEST(Presets, ExampleTwoHasOneLengthWidthAndMass) {
  for (const char* name :
       {"type-i", "type-ii-as-stated", "type-ii-as-counted", "type-iii-as-stated", "type-iii-as-counted"}) {
    const auto scene = scenes::build(find_preset(name)->spec);
    const SceneFacts facts = facts_of(*scene);
    EXPECT_NEAR(facts.length, 512.0, 1.0) << name;
    EXPECT_NEAR(facts.width, 128.0, 2.5) << name;
    EXPECT_NEAR(facts.mass * 1e6, 72.5, 1.8) << name;  // grams of the walls; Eq. 48-50 count the joints' overlap once
  }
}

template <class Lattice>
SceneSpec lattice_of(int columns, int rows) {
  Lattice lattice;
  lattice.columns = columns;
  lattice.rows = rows;
  lattice.side_mm = 3.0;
  lattice.wall_thickness_mm = 0.2;
  SceneSpec spec;
  spec.lattice = lattice;
  spec.elements_per_wall = 2;
  return spec;
}

void expect_planar(const SceneSpec& lattice, int cells) {
  const Layout layout = lay_out_cells(lattice);
  EXPECT_EQ(static_cast<int>(layout.joints.size()) - static_cast<int>(layout.walls.size()) + cells, 1);  // Euler
  Vector2 high = Vector2::Zero();
  for (const LayoutWall& wall : layout.walls) {
    EXPECT_NEAR((layout.joints[wall.end] - layout.joints[wall.start]).norm(), 3.0, 1e-12);
  }
  for (const Vector2& joint : layout.joints) {
    EXPECT_TRUE((joint.array() > -1e-9).all());
    high = high.cwiseMax(joint);
  }
  EXPECT_NEAR((high - envelope_of(lattice)).norm(), 0.0, 1e-9);
}

TEST(Lattices, SquaresAndTrianglesArePlanarWithEqualWallsAndFillTheirEnvelope) {
  expect_planar(lattice_of<SquareLattice>(7, 4), 28);
  for (const int rows : {3, 4}) {
    expect_planar(lattice_of<TriangleLattice>(7, rows), rows * 13);
  }
}

TEST(Lattices, StiffRowsThickenAllWallsOfTheirCells) {
  SceneSpec spec = lattice_of<HexagonLattice>(5, 4);
  spec.inclusions = {{2}, 4.0};
  const Layout layout = lay_out_cells(spec);
  int thick = 0;
  for (const LayoutWall& wall : layout.walls) {
    thick += wall.thickness == 0.8 ? 1 : 0;
    EXPECT_TRUE(wall.thickness == 0.8 || wall.thickness == 0.2);
  }
  EXPECT_EQ(thick, 4 * 6 - 3);  // the four cells of row 2 share three walls
}

TEST(Imperfection, IsBoundedSeededAndRepeatable) {
  SceneSpec spec = scenes::hexagon_specimen(6, 5);
  const auto perfect = scenes::build(spec);
  spec.imperfection = {0.05, 1};
  const auto first = scenes::build(spec);
  const auto again = scenes::build(spec);
  spec.imperfection.seed = 2;
  const auto other = scenes::build(spec);
  double greatest = 0.0;
  int different = 0;
  for (std::size_t i = 0; i < perfect->particle_count(); ++i) {
    greatest = std::max(greatest, (first->position[i] - perfect->position[i]).cwiseAbs().maxCoeff());
    EXPECT_EQ(first->position[i], again->position[i]);
    different += first->position[i] != other->position[i] ? 1 : 0;
  }
  EXPECT_LE(greatest, 0.05);
  EXPECT_GT(greatest, 0.03);
  EXPECT_EQ(different, static_cast<int>(perfect->particle_count()));
  EXPECT_EQ(first->length, perfect->length);
}

}  // namespace
}  // namespace cellcrush

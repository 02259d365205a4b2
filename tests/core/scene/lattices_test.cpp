#include "scenes/lattices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "lattice/lattice.h"
#include "scenes/frames.h"
#include "scenes/presets.h"

namespace cellcrush {
namespace {

// As in the paper, with two elements per wall.
TEST(Presets, HaveExactlyTheParticlesOfThePaperAndExampleTwoOneLengthWidthAndMass) {
  const std::pair<const char*, std::int64_t> counts[] = {{"type-i", 8099},
                                                         {"type-ii-as-stated", 12609},
                                                         {"type-ii-as-counted", 4125},
                                                         {"type-iii-as-stated", 19200},
                                                         {"type-iii-as-counted", 6364},
                                                         {"papka-kyriakides-1", 814},
                                                         {"papka-kyriakides-2", 814}};
  for (const auto& [name, particles] : counts) {
    SceneSpec spec = scenes::preset(name);
    spec.elements_per_wall = 2;
    const auto scene = scenes::build(spec);
    ASSERT_TRUE(scene) << name;
    const SceneFacts facts = facts_of(*scene);
    EXPECT_EQ(facts.particle_count, particles) << name;
    if (std::string(name).starts_with("papka")) continue;
    EXPECT_NEAR(facts.length, 512.0, 1.0) << name;
    EXPECT_NEAR(facts.width, 128.0, 2.5) << name;
    EXPECT_NEAR(facts.mass * 1e6, 72.5, 1.8) << name;  // grams of the walls; Eq. 48-50 count the joints' overlap once
  }
}

TEST(TypeI, HasExactlyTheElementsMassAndStepsOfThePaper) {
  const auto scene = scenes::build(scenes::preset("type-i"));
  ASSERT_TRUE(scene);
  const SceneFacts facts = facts_of(*scene);
  EXPECT_EQ(facts.element_count, 9642);
  EXPECT_NEAR(facts.mass * 1e6, 4821 * 4.0 * 0.3464 * 4.0 * 2700e-6, 1e-9);  // grams
  EXPECT_NEAR(facts.mass * 1e6, 72.15, 0.01);
  EXPECT_NEAR(facts.length, 512.7, 0.05);
  EXPECT_NEAR(facts.width, 128.0, 1e-9);
  EXPECT_NEAR(scene->stable_step, 3.91e-7, 0.01e-7);
  SceneSpec fixed = scenes::preset("type-i");
  fixed.numerics.time_step_s = 2e-7;
  EXPECT_NEAR(static_cast<double>(facts_of(*scenes::build(fixed)).step_count), 20500.0, 20.0);
  EXPECT_EQ(scene->section.section_count(), 4u);
  EXPECT_EQ(scene->section.depth_count(), 6u);
}

SceneSpec spec_of(const RegularLattice& lattice) {
  SceneSpec spec;
  spec.lattice = lattice;
  spec.elements_per_wall = 2;
  return spec;
}

/// Layout of a lattice of sides of 3 mm, with that many cells and that extent, mm.
Layout expect_planar(const RegularLattice& lattice, int cells, const Vector2& envelope) {
  const SceneSpec spec = spec_of(lattice);
  Layout layout = kind_of(spec)->lay_out(spec);
  EXPECT_EQ(static_cast<int>(layout.joints.size()) - static_cast<int>(layout.walls.size()) + cells, 1);  // Euler
  Vector2 high = Vector2::Zero();
  for (const LayoutWall& wall : layout.walls) {
    EXPECT_NEAR((layout.joints[wall.end] - layout.joints[wall.start]).norm(), 3.0, 1e-12);
  }
  for (const Vector2& joint : layout.joints) {
    EXPECT_TRUE((joint.array() > -1e-9).all());
    high = high.cwiseMax(joint);
  }
  EXPECT_NEAR((high - envelope).norm(), 0.0, 1e-9);
  return layout;
}

TEST(Lattices, ArePlanarWithEqualWallsAndFillTheirEnvelope) {
  expect_planar(scenes::squares(7, 4, 3.0, 0.2), 28, {21.0, 12.0});
  for (const int rows : {3, 4})
    expect_planar(scenes::triangles(7, rows, 3.0, 0.2), rows * 13, {21.0, rows * 1.5 * std::sqrt(3.0)});
  const Layout hexagons =
      expect_planar(scenes::hexagons(9, 6, 3.0, 0.2, 0.4), 3 * 9 + 3 * 8, {27.0 * std::sqrt(3.0), 28.5});
  std::map<int, int> degree;
  for (const LayoutWall& wall : hexagons.walls) {
    const double across = hexagons.joints[wall.end].x() - hexagons.joints[wall.start].x();
    EXPECT_EQ(wall.thickness, std::abs(across) < 1e-9 ? 0.4 : 0.2);
    ++degree[wall.start];
    ++degree[wall.end];
  }
  for (const auto& [joint, walls] : degree) EXPECT_TRUE(walls == 2 || walls == 3) << "joint " << joint;
}

TEST(Lattices, StiffRowsThickenAllWallsOfTheirCells) {
  SceneSpec spec = spec_of(scenes::hexagons(5, 4, 3.0, 0.2));
  spec.inclusions = {{2}, 4.0};
  int thick = 0;
  for (const LayoutWall& wall : kind_of(spec)->lay_out(spec).walls) {
    thick += wall.thickness == 0.8 ? 1 : 0;
    EXPECT_TRUE(wall.thickness == 0.8 || wall.thickness == 0.2);
  }
  EXPECT_EQ(thick, 4 * 6 - 3);  // the four cells of row 2 share three walls
}

TEST(Hexagons, AlongYTurnLengthAndWidthAndElementsAWallDivideEveryWall) {
  SceneSpec spec = scenes::hexagon_specimen(5, 4);
  const auto two = scenes::build(spec);
  spec.loading.direction = LoadingSpec::Direction::y;
  spec.elements_per_wall = 5;
  const auto five = scenes::build(spec);
  ASSERT_TRUE(two && five);
  EXPECT_NEAR(five->length, 26.0, 1e-9);
  EXPECT_NEAR(five->width, 5.0 * 4.0 * std::sqrt(3.0), 1e-9);
  EXPECT_EQ(five->plates.axis, 1);
  EXPECT_EQ(five->element_count(), two->element_count() / 2 * 5);
  EXPECT_NEAR(five->total_mass, two->total_mass, 1e-15);
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

/// Offsets of the particles of each wall of a scene from the straight line between its joints, in their order.
std::vector<std::vector<double>> bows_of(const Scene& scene) {
  std::vector<std::vector<double>> bows;
  for (const WallBlock& block : scene.walls.blocks) {
    for (int w = 0; w < block.walls; ++w) {
      const Vector2& from = scene.position[scene.walls.start[block.first_wall + w]];
      const Vector2 along = (scene.position[scene.walls.end[block.first_wall + w]] - from).normalized();
      std::vector<double>& bow = bows.emplace_back();
      for (int j = 0; j + 1 < block.elements; ++j) {
        const Vector2 offset = scene.position[block.first_inner + j * block.walls + w] - from;
        bow.push_back(along.x() * offset.y() - along.y() * offset.x());
      }
    }
  }
  return bows;
}

SceneSpec crushed_squares(const Imperfection& imperfection) {
  SceneSpec spec = spec_of(scenes::squares(7, 4, 3.0, 0.2));
  spec.depth_mm = 3.0;
  spec.material = scenes::preset("type-ii-as-counted").material;
  spec.elements_per_wall = 4;
  spec.imperfection = imperfection;
  spec.loading.speed_m_per_s = 2.0;
  spec.loading.end_strain = 0.01;
  return spec;
}

TEST(Lattices, BowedWallsAreHalfSineWavesWithinTheBowAndStrangersToTheJoints) {
  SceneSpec spec = crushed_squares({0.02, 3, 0.05});
  const auto scene = scenes::build(spec);
  double largest = 0.0;
  double sum = 0.0;
  const auto bows = bows_of(*scene);
  for (const std::vector<double>& bow : bows) {
    ASSERT_EQ(bow.size(), 3u);
    EXPECT_NEAR(bow[0], std::sqrt(0.5) * bow[1], 1e-14);
    EXPECT_NEAR(bow[2], bow[0], 1e-14);
    largest = std::max(largest, std::abs(bow[1]));
    sum += bow[1];
  }
  EXPECT_GT(largest, 0.045);
  EXPECT_LE(largest, 0.05);
  EXPECT_LT(std::abs(sum) / static_cast<double>(bows.size()), 0.01) << "to either side";
  spec.imperfection.bow_mm = 0.0;
  const auto straight = scenes::build(spec);
  for (int joint = 0; joint < scene->joint_count; ++joint) {
    EXPECT_EQ(straight->position[joint], scene->position[joint]);
  }
  for (const std::vector<double>& bow : bows_of(*straight)) EXPECT_NEAR(bow[1], 0.0, 1e-14);
}

/// Highest impact stress up to 1 % strain, at which straight walls buckle.
double first_peak_of_squares(double bow) {
  Simulation simulation(scenes::build(crushed_squares({0.001, 1, bow})));
  EXPECT_NEAR(simulation.take_sample().energies.elastic, 0.0, 1e-20) << "walls have no stress in the bowed shape";
  double peak = 0.0;
  scenes::watch(
      simulation, [&](const Sample& sample) { peak = std::max(peak, sample.stress_impact); }, 50);
  return peak;
}

TEST(Lattices, BowedWallsBuckleSooner) { EXPECT_LT(first_peak_of_squares(0.14), 0.9 * first_peak_of_squares(0.0)); }

}  // namespace
}  // namespace cellcrush

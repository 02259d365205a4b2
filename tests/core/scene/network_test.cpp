// A lattice that is given as lists of joints and walls.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/presets.h"
#include "scenes/state_hash.h"

namespace cellcrush {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Hash of the state after some steps, in which the plate has come to the walls.
std::uint64_t hash_after(const SceneSpec& spec, int steps) {
  Simulation simulation(scenes::build(spec));
  simulation.advance(steps);
  return scenes::hash_of(simulation.state());
}

TEST(Network, OfARegularLatticeHasItsBits) {
  for (const char* preset : {"hexagon-small", "type-ii-as-counted", "type-iii-as-counted"}) {
    for (const auto direction : {LoadingSpec::Direction::x, LoadingSpec::Direction::y}) {
      SceneSpec spec = scenes::preset(preset);
      scenes::cells_of(spec).columns = 7;
      scenes::cells_of(spec).rows = 5;
      spec.loading.direction = direction;
      spec.elements_per_wall = 4;
      spec.imperfection = {.amplitude_mm = 0.02, .seed = 5, .bow_mm = 0.02};
      EXPECT_EQ(hash_after(scenes::as_network(spec), 300), hash_after(spec, 300)) << preset;
    }
  }
}

// Large enough for its joints to be numbered column by column, and for bands.
TEST(Network, OfTypeIHasItsBitsAndFacts) {
  const SceneSpec spec = scenes::preset("type-i");
  const SceneSpec network = scenes::as_network(spec);
  EXPECT_EQ(hash_after(network, 50), hash_after(spec, 50));
  const SceneFacts facts = facts_of(*scenes::build(spec));
  const SceneFacts of_network = facts_of(*scenes::build(network));
  EXPECT_EQ(of_network.step_count, facts.step_count);
  EXPECT_EQ(of_network.length, facts.length);
  EXPECT_EQ(of_network.width, facts.width);
  EXPECT_EQ(of_network.relative_density, facts.relative_density);
  EXPECT_EQ(of_network.theory.gibson_ashby, 0.0) << "no closed form is known of it";
}

/// Type I as a network of a bit uneven walls, whose numbers of elements differ.
SceneSpec uneven_type_i(int elements_per_wall) {
  SceneSpec spec = scenes::as_network(scenes::preset("type-i"));
  spec.elements_per_wall = elements_per_wall;
  spec.imperfection = {};
  int turn = 0;
  for (double& place : std::get<NetworkWalls>(spec.lattice).joints_mm) place += 0.12 * (turn++ * 7 % 11 - 5);
  return spec;
}

// The walls of other blocks take several times as long.
TEST(Network, WallsOfUnequalLengthsFillBlocks) {
  for (const SceneSpec& spec : {scenes::preset("zheng-2005"), uneven_type_i(4)}) {
    const auto scene = scenes::build(spec);
    std::size_t in_full = 0;
    std::set<int> counts;
    for (const WallBlock& block : scene->walls.blocks) {
      if (block.walls == kMostWallsInBlock) in_full += kMostWallsInBlock;
      counts.insert(block.elements);
    }
    EXPECT_GE(counts.size(), 3u);
    EXPECT_GE(static_cast<double>(in_full), 0.95 * static_cast<double>(scene->walls.start.size()));
  }
}

// The second is large enough for its joints to be numbered column by column.
TEST(Network, JointsAndWallsKeepTheirNumbersInTheList) {
  for (const SceneSpec& spec : {uneven_type_i(4), uneven_type_i(16)}) {
    const auto scene = scenes::build(spec);
    const auto& network = std::get<NetworkWalls>(spec.lattice);
    const ListOrder& order = scene->list_order;
    const auto place_of = [&](int joint) {
      return Vector2(network.joints_mm[2 * joint], network.joints_mm[2 * joint + 1]);
    };
    std::set<int> seen;
    for (int wall = 0; wall < static_cast<int>(scene->walls.start.size()); ++wall) {
      const int listed = order.listed_wall(wall);
      seen.insert(listed);
      for (const auto& [joint, of_list] : {std::pair(scene->walls.start[wall], network.walls[2 * listed]),
                                           std::pair(scene->walls.end[wall], network.walls[2 * listed + 1])}) {
        EXPECT_EQ(order.listed_joint(joint), of_list);
        EXPECT_EQ(scene->position[joint], place_of(of_list));
      }
    }
    EXPECT_EQ(seen.size(), network.wall_count());
  }
}

TEST(Network, OfUnevenWallsHasTheSameBitsInWhateverOrderTheyAreListed) {
  const SceneSpec spec = uneven_type_i(2);
  SceneSpec reversed = spec;
  auto& network = std::get<NetworkWalls>(reversed.lattice);
  const auto& given = std::get<NetworkWalls>(spec.lattice);
  const auto joints = static_cast<int>(given.joint_count());
  for (int joint = 0; joint < joints; ++joint) {
    for (int axis : {0, 1}) {
      network.joints_mm[2 * joint + axis] = given.joints_mm[2 * (joints - 1 - joint) + axis];
    }
  }
  const std::size_t walls = given.wall_count();
  for (std::size_t wall = 0; wall < walls; ++wall) {
    for (std::size_t end : {0, 1}) {
      network.walls[2 * wall + end] = joints - 1 - given.walls[2 * (walls - 1 - wall) + end];
    }
  }
  std::ranges::reverse(network.thicknesses_mm);
  EXPECT_EQ(hash_after(reversed, 50), hash_after(spec, 50));
}

/// A ring of four quarter arcs of a radius, between plates.
SceneSpec ring(double radius) {
  SceneSpec spec = scenes::preset("hexagon-small");
  const double rise = radius * (1.0 - std::sqrt(0.5));
  spec.lattice = NetworkWalls{.joints_mm = {radius, 0.0, 0.0, radius, -radius, 0.0, 0.0, -radius},
                              .walls = {0, 1, 1, 2, 2, 3, 3, 0},
                              .wall_thickness_mm = 0.1,
                              .thicknesses_mm = {},
                              .rises_mm = {-rise, -rise, -rise, -rise},
                              .materials = {},
                              .wall_materials = {}};
  spec.elements_per_wall = 6;
  spec.imperfection = {};
  return spec;
}

TEST(Network, ArcsLieOnTheirCircleInEqualElements) {
  const double radius = 5.0;
  const auto scene = scenes::build(ring(radius));
  ASSERT_TRUE(scene);
  ASSERT_EQ(scene->particle_count(), 24U);
  for (const Vector2& place : scene->position) EXPECT_NEAR(place.norm(), radius, 1e-12);
  for (const double length : scene->walls.undeformed_length) {
    EXPECT_NEAR(length, 2.0 * radius * std::sin(0.25 * std::acos(-1.0) / 6.0), 1e-12);
  }
  EXPECT_NEAR(scene->length, 2.0 * radius, 1e-12);
}

TEST(Network, WallsHaveThicknessesAndMaterialsOfTheirOwn) {
  SceneSpec spec = ring(5.0);
  auto& network = std::get<NetworkWalls>(spec.lattice);
  network.rises_mm.clear();
  network.thicknesses_mm = {0.1, 0.2, 0.3, 0.4};
  network.materials = {spec.material};
  network.materials[0].density_kg_per_m3 = 2.0 * *spec.material.density_kg_per_m3;
  network.wall_materials = {0, 0, 0, 1};
  const auto scene = scenes::build(spec);
  ASSERT_TRUE(scene);
  const double side = 5.0 * std::sqrt(2.0);
  const double area = side * (0.1 + 0.2 + 0.3 + 2.0 * 0.4);
  EXPECT_NEAR(scene->total_mass / (area * *spec.depth_mm * *spec.material.density_kg_per_m3 * 1e-12), 1.0, 1e-12);
}

std::vector<std::string> fields_with(const std::function<void(NetworkWalls&)>& change) {
  SceneSpec spec = ring(5.0);
  change(std::get<NetworkWalls>(spec.lattice));
  std::vector<std::string> fields;
  for (const Problem& problem : build_scene(spec).problems) fields.push_back(problem.field);
  return fields;
}

TEST(Network, ListsThatDoNotFitAreRefusedWithTheirEntries) {
  EXPECT_THAT(fields_with([](NetworkWalls&) {}), IsEmpty());
  EXPECT_THAT(fields_with([](NetworkWalls& network) { network.walls[5] = 4; }),
              ElementsAre("lattice.network.walls[5]"));
  EXPECT_THAT(fields_with([](NetworkWalls& network) {
                network.joints_mm.insert(network.joints_mm.end(), {9.0, 9.0});
              }),
              ElementsAre("lattice.network.joints_mm[8]"));
  EXPECT_THAT(fields_with([](NetworkWalls& network) { network.walls.push_back(0); }),
              ElementsAre("lattice.network.walls"));
  EXPECT_THAT(fields_with([](NetworkWalls& network) { network.joints_mm[3] = std::nan(""); }),
              testing::Contains("lattice.network.joints_mm[3]"));
  EXPECT_THAT(fields_with([](NetworkWalls& network) { network.wall_thickness_mm.reset(); }),
              ElementsAre("lattice.network.wall_thickness_mm"));
  EXPECT_THAT(fields_with([](NetworkWalls& network) {
                network.thicknesses_mm = {0.1, 0.1, 0.1};
              }),
              ElementsAre("lattice.network.thicknesses_mm"));
  EXPECT_THAT(fields_with([](NetworkWalls& network) {
                network.thicknesses_mm = {0.1, 0.1, 0.1, 0.0};
              }),
              ElementsAre("lattice.network.thicknesses_mm[3]"));
  EXPECT_THAT(fields_with([](NetworkWalls& network) { network.rises_mm[2] = 20.0; }),
              ElementsAre("lattice.network.rises_mm[2]"));
  EXPECT_THAT(fields_with([](NetworkWalls& network) {
                network.wall_materials = {0, 0, 0, 1};
              }),
              ElementsAre("lattice.network.wall_materials[3]"));
  // The same two joints by two arcs are two walls; by the same arc they are one.
  EXPECT_THAT(fields_with([](NetworkWalls& network) {
                network.walls.insert(network.walls.end(), {1, 0});
                network.rises_mm.push_back(-network.rises_mm[0]);
              }),
              ElementsAre("lattice.network.walls[8]"));
}

}  // namespace
}  // namespace cellcrush

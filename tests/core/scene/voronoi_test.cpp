// Voronoi honeycombs: nuclei, walls, bits and elastic moduli.
#include "lattice/voronoi.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/spec_checker.h"
#include "core/reference/beam_network.h"
#include "geometry/find_parts.h"
#include "lattice/nuclei.h"
#include "scenes/evidence.h"
#include "scenes/frames.h"
#include "scenes/presets.h"

namespace cellcrush {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

constexpr double kVoronoiSide = 4.0;  // mm

VoronoiWalls voronoi(int columns, int rows, double irregularity, std::uint64_t seed = 1) {
  VoronoiWalls lattice;
  lattice.columns = columns;
  lattice.rows = rows;
  lattice.side_mm = kVoronoiSide;
  lattice.irregularity = irregularity;
  lattice.seed = seed;
  lattice.wall_thickness_mm = 0.05 * kVoronoiSide;
  return lattice;
}

std::vector<int> walls_at_joints(const Layout& layout) {
  std::vector<int> walls(layout.joints.size(), 0);
  for (const LayoutWall& wall : layout.walls) {
    ++walls[wall.start];
    ++walls[wall.end];
  }
  return walls;
}

double total_length(const Layout& layout) {
  double length = 0.0;
  for (const LayoutWall& wall : layout.walls) length += layout.chord_of(wall);
  return length;
}

/// Modulus of the lattice over that of the wall, between plates without friction.
double modulus_of(const VoronoiWalls& lattice, int axis) {
  const VoronoiLayout made = lay_out_voronoi(lattice);
  reference::BeamNetwork network;
  for (const Vector2& joint : made.layout.joints) network.joints.push_back({joint.x(), joint.y()});
  for (const LayoutWall& wall : made.layout.walls) network.walls.push_back({wall.start, wall.end, wall.thickness});
  return reference::modulus_between_plates(network, axis);
}

TEST(Voronoi, OfIrregularityZeroIsTheLatticeOfRegularHexagons) {
  const VoronoiLayout made = lay_out_voronoi(voronoi(8, 6, 0.0));
  const std::vector<int> walls = walls_at_joints(made.layout);
  EXPECT_EQ(std::ranges::count(walls, 3), 2 * 8 * 6) << "two joints a cell, all of them in the rectangle";
  EXPECT_EQ(std::ranges::count(walls, 1) + 2 * 8 * 6, static_cast<int>(walls.size())) << "others lie on the edges";
  for (const LayoutWall& wall : made.layout.walls) {
    if (walls[wall.start] != 3 || walls[wall.end] != 3) continue;
    EXPECT_NEAR(made.layout.chord_of(wall), kVoronoiSide, 1e-5);
    const Vector2 along = made.layout.joints[wall.end] - made.layout.joints[wall.start];
    const double turns = std::atan2(along.y(), along.x()) / (std::acos(-1.0) / 3.0) - 0.5;
    EXPECT_NEAR(turns, std::round(turns), 1e-5) << "walls lie along y and at 30 degrees to x";
  }
  EXPECT_NEAR(total_length(made.layout), 3.0 * 8 * 6 * kVoronoiSide, 1e-4);
  EXPECT_EQ(made.islands.count, 0);
}

// The free edges lower the modulus in the ratio of the circumference to the area, so that twice the larger block less
// the smaller one has almost none of it.
TEST(Voronoi, OfIrregularityZeroHasTheModulusOfTheHexagons) {
  const double slenderness = 0.05;
  const double thin = 4.0 / std::sqrt(3.0) * std::pow(slenderness, 3.0);
  for (const int axis : {0, 1}) {
    const double closed_form = thin / (1.0 + 3.0 * slenderness * slenderness);
    const double infinite = 2.0 * modulus_of(voronoi(24, 28, 0.0), axis) - modulus_of(voronoi(12, 14, 0.0), axis);
    scenes::record_figure(axis == 0 ? "modulus along x" : "modulus along y", infinite / closed_form, 4);
    EXPECT_NEAR(infinite / closed_form, 1.0, 0.02) << axis;
  }
}

TEST(Voronoi, NucleiKeepTheLeastDistanceAndReachIt) {
  for (const double irregularity : {0.1, 0.3, 0.6, 0.9}) {
    const Nuclei nuclei = place_nuclei(voronoi(16, 12, irregularity));
    ASSERT_EQ(nuclei.places.size(), 16U * 12U);
    double least = 1e300;
    for (std::size_t i = 0; i < nuclei.places.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const auto apart = [](std::int64_t distance, std::int64_t period) {
          return static_cast<double>(std::min(std::abs(distance), period - std::abs(distance)));
        };
        least = std::min(least, std::hypot(apart(nuclei.places[i].x - nuclei.places[j].x, nuclei.period.x),
                                           apart(nuclei.places[i].y - nuclei.places[j].y, nuclei.period.y)));
      }
    }
    const double reached = 1.0 - least / static_cast<double>(nuclei.pitch);
    EXPECT_LE(reached, irregularity + 1e-6);
    EXPECT_GT(reached, irregularity - 0.05);
  }
}

TEST(Voronoi, JoinsThreeWallsAtAJointAndFillsItsRectangle) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const VoronoiWalls lattice = voronoi(14, 12, 1.0, seed);
    const VoronoiLayout made = lay_out_voronoi(lattice);
    const Layout& layout = made.layout;
    const Vector2 envelope = envelope_of(lattice);
    const std::vector<int> part = find_parts(layout.joints.size(), layout.walls);
    EXPECT_EQ(std::set<int>(part.begin(), part.end()).size(), 1U);
    const std::vector<int> walls = walls_at_joints(layout);
    int joints_of_three = 0;
    for (std::size_t joint = 0; joint < walls.size(); ++joint) {
      const Vector2& place = layout.joints[joint];
      const bool on_edge =
          place.x() == 0.0 || place.y() == 0.0 || place.x() == envelope.x() || place.y() == envelope.y();
      EXPECT_TRUE(walls[joint] != 1 || on_edge) << place.transpose();
      joints_of_three += walls[joint] == 3 ? 1 : 0;
    }
    EXPECT_NEAR(joints_of_three, 2 * 14 * 12, 12) << "some lie close together and are one, of more walls";
  }
}

TEST(Voronoi, WithEdgeWallsHasNoFreeEnds) {
  VoronoiWalls lattice = voronoi(10, 8, 0.7);
  const double open = total_length(lay_out_voronoi(lattice).layout);
  lattice.edge_walls = true;
  const Layout layout = lay_out_voronoi(lattice).layout;
  const double tolerance = 0.5 * kVoronoiSide;  // islands at the corners are joined now
  EXPECT_NEAR(total_length(layout) - open, 2.0 * envelope_of(lattice).sum(), tolerance);
  EXPECT_GE(std::ranges::min(walls_at_joints(layout)), 2);
}

TEST(Voronoi, RelaxationMakesCellsAlike) {
  const auto spread_after = [](int steps) {
    VoronoiWalls lattice = voronoi(14, 12, 1.0);
    lattice.relaxation_steps = steps;
    const Layout layout = lay_out_voronoi(lattice).layout;
    double square = 0.0;
    for (const LayoutWall& wall : layout.walls) square += std::pow(layout.chord_of(wall), 2.0);
    const double mean = total_length(layout) / static_cast<double>(layout.walls.size());
    return std::sqrt(square / static_cast<double>(layout.walls.size()) - mean * mean) / mean;
  };
  EXPECT_GT(spread_after(0), 0.5);
  EXPECT_LT(spread_after(3), 0.85 * spread_after(0));
  EXPECT_LT(spread_after(20), 0.8 * spread_after(3));
}

std::uint64_t hash_of(const Layout& layout) {
  std::uint64_t hash = 14695981039346656037ULL;  // FNV-1a, of 64 bits at a time
  const auto add = [&hash](std::uint64_t value) { hash = (hash ^ value) * 1099511628211ULL; };
  for (const Vector2& joint : layout.joints) {
    add(std::bit_cast<std::uint64_t>(joint.x()));
    add(std::bit_cast<std::uint64_t>(joint.y()));
  }
  for (const LayoutWall& wall : layout.walls) {
    add(static_cast<std::uint64_t>(wall.start));
    add(static_cast<std::uint64_t>(wall.end));
    add(std::bit_cast<std::uint64_t>(wall.thickness));
  }
  return hash;
}

// The numbers are those of the first machine. They hold on every one.
TEST(Voronoi, OfASeedHasItsBits) {
  VoronoiWalls lattice = voronoi(20, 16, 0.5, 7);
  EXPECT_EQ(hash_of(lay_out_voronoi(lattice).layout), 10911521228593018484U);
  lattice.relaxation_steps = 4;
  lattice.irregularity = 1.0;
  lattice.edge_walls = true;
  lattice.wall_thickness_mm.reset();
  lattice.relative_density = 0.08;
  EXPECT_EQ(hash_of(lay_out_voronoi(lattice).layout), 3663121144253792578U);
  lattice.seed = 8;
  EXPECT_NE(hash_of(lay_out_voronoi(lattice).layout), 3663121144253792578U);
}

// A random honeycomb has no direction of its own.
TEST(Voronoi, IsAsStiffAlongXAsAlongY) {
  double sum = 0.0;
  double squares = 0.0;
  constexpr int kSeeds = 8;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const VoronoiWalls lattice = voronoi(14, 16, 0.8, seed);  // as long as it is wide
    const double difference = std::log(modulus_of(lattice, 0) / modulus_of(lattice, 1));
    sum += difference;
    squares += difference * difference;
  }
  const double mean = sum / kSeeds;
  const double error_of_mean = std::sqrt((squares / kSeeds - mean * mean) / (kSeeds - 1));
  scenes::record_bound("difference of the moduli in %", 100.0 * std::abs(mean), 10.0);
  EXPECT_LT(std::abs(mean), 3.0 * error_of_mean);
}

SceneSpec crushed(const VoronoiWalls& lattice) {
  SceneSpec spec = scenes::hexagon_specimen(4, 4);
  spec.imperfection = {};
  spec.lattice = lattice;
  spec.loading.speed_m_per_s = 100.0;
  return spec;
}

TEST(Voronoi, HasTheRelativeDensityThatIsGiven) {
  VoronoiWalls lattice = voronoi(10, 8, 0.6);
  lattice.wall_thickness_mm.reset();
  lattice.relative_density = 0.1;
  const auto scene = scenes::build(crushed(lattice));
  ASSERT_TRUE(scene);
  const SceneFacts facts = facts_of(*scene);
  EXPECT_NEAR(facts.relative_density, 0.1, 1e-12);
  EXPECT_NEAR(facts.length, envelope_of(lattice).x(), 1e-12);
  EXPECT_NEAR(facts.width, envelope_of(lattice).y(), 1e-12);
  EXPECT_THAT(facts.modelled, Contains(HasSubstr("Voronoi honeycomb of 80 cells")));
}

TEST(Voronoi, CheckersAndScenesAgree) {
  SpecChecker checker;
  for (const double speed : {100.0, 20.0}) {
    SceneSpec spec = crushed(voronoi(8, 6, 0.5));
    spec.loading.speed_m_per_s = speed;
    const SpecChecker::Verdict verdict = checker.check(spec);
    const auto scene = scenes::build(spec);
    ASSERT_TRUE(scene);
    EXPECT_EQ(verdict.step_count, facts_of(*scene).step_count);
    EXPECT_EQ(verdict.element_count, facts_of(*scene).element_count);
  }
}

// Some walls are a hundredth of the side long. Offsets as long as they are would make their neighbours cross.
TEST(Voronoi, ImperfectionsTurnNoShortWallAround) {
  SceneSpec spec = scenes::preset("zheng-2005");
  spec.imperfection.amplitude_mm = 0.1 * *std::get<VoronoiWalls>(spec.lattice).side_mm;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE(seed);
    std::get<VoronoiWalls>(spec.lattice).seed = seed;
    spec.imperfection.seed = seed;
    EXPECT_TRUE(scenes::build(spec));
  }
}

TEST(Voronoi, IsCrushedWithinItsLedger) {
  SceneSpec spec = crushed(voronoi(4, 4, 0.6, 5));
  spec.loading.end_strain = 0.15;
  Simulation simulation(scenes::build(spec));
  const Sample last = scenes::run_to_end(simulation).back();
  EXPECT_GT(last.energies.external, 0.0);
  EXPECT_LT(std::abs(last.energies.residual), 0.01 * last.energies.external);
}

std::vector<std::string> fields_with(const std::function<void(VoronoiWalls&)>& change) {
  VoronoiWalls lattice = voronoi(6, 6, 0.5);
  change(lattice);
  std::vector<std::string> fields;
  for (const Problem& problem : build_scene(crushed(lattice)).problems) fields.push_back(problem.field);
  return fields;
}

TEST(Voronoi, NamesTheFieldsThatAreWrong) {
  using ::testing::ElementsAre;
  EXPECT_THAT(fields_with([](VoronoiWalls& lattice) { lattice.rows = 5; }), ElementsAre("lattice.voronoi.rows"));
  EXPECT_THAT(fields_with([](VoronoiWalls& lattice) { lattice.columns = 1; }), ElementsAre("lattice.voronoi.columns"));
  EXPECT_THAT(fields_with([](VoronoiWalls& lattice) { lattice.irregularity = 1.1; }),
              ElementsAre("lattice.voronoi.irregularity"));
  EXPECT_THAT(fields_with([](VoronoiWalls& lattice) { lattice.relaxation_steps = -1; }),
              ElementsAre("lattice.voronoi.relaxation_steps"));
  EXPECT_THAT(fields_with([](VoronoiWalls& lattice) { lattice.wall_thickness_mm.reset(); }),
              ElementsAre("lattice.voronoi.wall_thickness_mm"));
  EXPECT_THAT(fields_with([](VoronoiWalls& lattice) { lattice.relative_density = 0.1; }),
              ElementsAre("lattice.voronoi.relative_density"));
  EXPECT_THAT(fields_with([](VoronoiWalls& lattice) {
                lattice.wall_thickness_mm.reset();
                lattice.relative_density = 0.9;
              }),
              ElementsAre("lattice.voronoi.relative_density"));
}

}  // namespace
}  // namespace cellcrush

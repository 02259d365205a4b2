// Changes of lattices: missing walls, scatter, grading, rotation, outline. And that the walls made are meshed as the
// network of them is.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <set>
#include <string>
#include <vector>

#include "cellcrush/fidelity.h"
#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/spec_checker.h"
#include "geometry/find_parts.h"
#include "lattice/layout.h"
#include "lattice/list_walls.h"
#include "lattice/network.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"
#include "scenes/state_hash.h"

namespace cellcrush {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

SceneSpec specimen(const RegularLattice& lattice, const LatticeChanges& changes) {
  SceneSpec spec = scenes::hexagon_specimen(4, 4);
  spec.imperfection = {};
  spec.lattice = lattice;
  spec.changes = changes;
  return spec;
}

LatticeChanges changed(const std::function<void(LatticeChanges&)>& change) {
  LatticeChanges changes;
  change(changes);
  return changes;
}

LatticeChanges missing(double fraction, std::uint64_t seed = 1) {
  return changed([=](LatticeChanges& changes) { changes.defects = {fraction, 0.0, seed}; });
}

LatticeChanges outlined(std::vector<double> corners, double edge_wall_thickness = 0.0) {
  return changed([&](LatticeChanges& changes) { changes.outline = {std::move(corners), edge_wall_thickness}; });
}

Layout layout_of(const SceneSpec& spec) {
  const ListedWalls listed = list_walls(fill_in_fidelity(spec));
  EXPECT_TRUE(listed.problems.empty());
  return lay_out_network(std::get<NetworkWalls>(listed.spec.lattice));
}

Layout squares_with(const LatticeChanges& changes, int columns = 10, int rows = 10) {
  return layout_of(specimen(scenes::squares(columns, rows, 3.0, 0.2), changes));
}

double wall_area(const Layout& layout) {
  double area = 0.0;
  for (const LayoutWall& wall : layout.walls) area += layout.chord_of(wall) * wall.thickness;
  return area;
}

std::size_t parts_in(const Layout& layout) {
  const std::vector<int> part = find_parts(layout.joints.size(), layout.walls);
  return std::set<int>(part.begin(), part.end()).size();
}

std::string words_of_walls(const SceneSpec& spec) { return list_walls(fill_in_fidelity(spec)).words; }

TEST(MissingWalls, AreAsManyAsAskedForAndSplitNothing) {
  for (const double fraction : {0.01, 0.1, 0.3, 0.5}) {
    for (const RegularLattice& lattice : {scenes::squares(10, 10, 3.0, 0.2), scenes::hexagons(10, 9, 3.0, 0.2)}) {
      const auto all = layout_of(specimen(lattice, missing(1e-9))).walls.size();
      const Layout left = layout_of(specimen(lattice, missing(fraction)));
      EXPECT_EQ(all - left.walls.size(), std::llround(fraction * static_cast<double>(all))) << fraction;
      EXPECT_EQ(parts_in(left), 1U) << fraction;
    }
  }
}

TEST(MissingWalls, AreToldWithTheFreeEndsThatTheyLeave) {
  const SceneSpec spec = specimen(scenes::squares(3, 1, 3.0, 0.2), missing(0.3));
  const Layout left = layout_of(spec);
  ASSERT_EQ(left.walls.size(), 7U);
  std::vector<int> walls(left.joints.size(), 0);
  for (const LayoutWall& wall : left.walls) {
    ++walls[wall.start];
    ++walls[wall.end];
  }
  const std::string free_ends = std::to_string(std::ranges::count(walls, 1));
  EXPECT_THAT(words_of_walls(spec), HasSubstr("3 walls missing, none of which splits the lattice, " + free_ends));
}

TEST(MissingWalls, FollowTheSeedAndNotTheScatter) {
  const auto middles = [](const LatticeChanges& changes) {
    const Layout layout = squares_with(changes);
    std::set<std::pair<double, double>> places;
    for (const LayoutWall& wall : layout.walls) {
      const Vector2 middle = 0.5 * (layout.joints[wall.start] + layout.joints[wall.end]);
      places.emplace(middle.x(), middle.y());
    }
    return places;
  };
  LatticeChanges scattered = missing(0.1);
  scattered.defects.thickness_scatter = 0.3;
  EXPECT_EQ(middles(missing(0.1)), middles(missing(0.1)));
  EXPECT_EQ(middles(missing(0.1)), middles(scattered));
  EXPECT_NE(middles(missing(0.1)), middles(missing(0.1, 2)));
}

TEST(ThicknessScatter, IsUniformWithinItsBounds) {
  const Layout layout = squares_with(changed([](LatticeChanges& changes) { changes.defects = {0.0, 0.4, 3}; }), 20, 20);
  double sum = 0.0;
  double squares = 0.0;
  for (const LayoutWall& wall : layout.walls) {
    const double offset = wall.thickness / 0.2 - 1.0;
    EXPECT_LE(std::abs(offset), 0.4);
    sum += offset;
    squares += offset * offset;
  }
  const auto count = static_cast<double>(layout.walls.size());
  EXPECT_NEAR(sum / count, 0.0, 4.0 * 0.4 / std::sqrt(3.0 * count));
  EXPECT_NEAR(squares / count, 0.4 * 0.4 / 3.0, 0.01);
}

// Squares of 10 columns: walls along y on the lines between strips belong to the strip above.
TEST(Grading, ByStepsKeepsTheMeanThicknessAndTheRatios) {
  const Layout layout = squares_with(changed([](LatticeChanges& changes) {
    changes.grading.thickness_steps = {1.0, 3.0};
  }));
  EXPECT_NEAR(wall_area(layout), wall_area(squares_with(missing(1e-9))), 1e-9);
  std::set<long> thicknesses;  // in nm
  for (const LayoutWall& wall : layout.walls) {
    const double x = 0.5 * (layout.joints[wall.start].x() + layout.joints[wall.end].x());
    thicknesses.insert(std::lround(1e6 * wall.thickness / (x < 15.0 - 1e-9 ? 1.0 : 3.0)));
  }
  EXPECT_EQ(thicknesses.size(), 1U) << "but for the factor, all walls are alike";
}

TEST(Grading, ByAPolynomialKeepsTheMeanThicknessAndFollowsIt) {
  const LatticeChanges changes = changed([](LatticeChanges& made) {
    made.grading.axis = Grading::Axis::y;
    made.grading.thickness_polynomial = {1.0, 2.0, -0.5};
  });
  const Layout layout = squares_with(changes);
  EXPECT_NEAR(wall_area(layout), wall_area(squares_with(missing(1e-9))), 1e-9);
  const double at_bottom = layout.walls.front().thickness;
  for (const LayoutWall& wall : layout.walls) {
    const double s = 0.5 * (layout.joints[wall.start].y() + layout.joints[wall.end].y()) / 30.0;
    EXPECT_NEAR(wall.thickness, at_bottom * (1.0 + 2.0 * s - 0.5 * s * s), 1e-12);
  }
}

TEST(Grading, OfSizesKeepsTheExtentAndTheRatios) {
  const LatticeChanges by_steps = changed([](LatticeChanges& made) { made.grading.size_steps = {1.0, 2.0}; });
  std::map<long, int> lines;  // walls along y at each x, in µm
  const Layout layout = squares_with(by_steps);
  for (const LayoutWall& wall : layout.walls) {
    const double x = layout.joints[wall.start].x();
    if (std::abs(layout.joints[wall.end].x() - x) < 1e-9) ++lines[std::lround(1e3 * x)];
  }
  std::vector<long> places;
  for (const auto& [place, walls] : lines) places.push_back(place);
  EXPECT_THAT(places, ElementsAre(0, 2000, 4000, 6000, 8000, 10000, 14000, 18000, 22000, 26000, 30000));
  const LatticeChanges linear = changed([](LatticeChanges& made) { made.grading.size_polynomial = {1.0, 2.0}; });
  for (const Vector2& joint : squares_with(linear).joints) {
    const double s = 0.5 * (std::sqrt(1.0 + 8.0 * joint.x() / 30.0) - 1.0);  // of x = 30 (s + s^2) / 2
    EXPECT_NEAR(10.0 * s, std::round(10.0 * s), 1e-9);
  }
}

TEST(Rotation, TurnsAsTheMathematicsLibraryDoes) {
  for (double degrees = -360.0; degrees <= 360.0; degrees += 7.3) {
    const Turn turn = turn_by(degrees);
    EXPECT_NEAR(turn.cosine, std::cos(degrees * std::numbers::pi / 180.0), 1e-15) << degrees;
    EXPECT_NEAR(turn.sine, std::sin(degrees * std::numbers::pi / 180.0), 1e-15) << degrees;
  }
  EXPECT_EQ(turn_by(90.0).cosine, 0.0);
  EXPECT_EQ(turn_by(-90.0).sine, -1.0);
  EXPECT_EQ(turn_by(180.0).cosine, -1.0);
}

TEST(Rotation, ByARightAngleExchangesLengthAndWidth) {
  SceneSpec spec = specimen(scenes::hexagons(5, 4, 3.0, 0.2), {});
  const auto upright = scenes::build(spec);
  spec.changes.rotation_degrees = 90.0;
  const auto turned = scenes::build(spec);
  ASSERT_TRUE(upright && turned);
  EXPECT_NEAR(turned->length, upright->width, 1e-9);
  EXPECT_NEAR(turned->width, upright->length, 1e-9);
  EXPECT_NEAR(turned->total_mass, upright->total_mass, 1e-15);
}

TEST(Outline, CutsWallsAtARectangle) {
  // Four lines of walls either way, each of three whole walls and two halves.
  const Layout layout = squares_with(outlined({4.5, 16.5, 16.5, 4.5}));
  EXPECT_EQ(layout.walls.size(), 2U * 4U * 5U);
  EXPECT_EQ(layout.joints.size(), 4U * 4U + 4U * 4U);
  EXPECT_NEAR(wall_area(layout), 2.0 * 4.0 * 12.0 * 0.2, 1e-12);
}

TEST(Outline, HasWallsOfItsOwn) {
  const Layout layout = squares_with(outlined({4.5, 4.5, 16.5, 16.5}, 0.1));
  EXPECT_EQ(layout.walls.size(), 2U * 4U * 5U + 4U * 5U);
  EXPECT_NEAR(wall_area(layout), 2.0 * 4.0 * 12.0 * 0.2 + 4.0 * 12.0 * 0.1, 1e-12);
}

TEST(Outline, KeepsWallsThatLieOnIt) {
  const SceneSpec spec = specimen(scenes::squares(5, 5, 3.0, 0.2), outlined({0.0, 0.0, 15.0, 15.0}));
  EXPECT_EQ(layout_of(spec).walls.size(), 60U);
}

TEST(Outline, CutsWallsAtATriangle) {
  const Layout layout = squares_with(outlined({0.0, 0.0, 30.0, 0.0, 0.0, 30.0}));
  EXPECT_EQ(layout.walls.size(), 110U) << "half of the walls; the longest side runs from joint to joint";
  for (const Vector2& joint : layout.joints) EXPECT_LE(joint.sum(), 30.0 + 1e-9);
}

TEST(Outline, LeavesOutTheSmallerOfTwoPartsAndSaysSo) {
  // Two rectangles and a neck between them in which no wall lies.
  const LatticeChanges dumbbell = outlined({1.0,  1.0,  10.0, 1.0,  10.0, 4.0, 20.0, 4.0, 20.0, 1.0, 29.0, 1.0,
                                            29.0, 29.0, 20.0, 29.0, 20.0, 5.0, 10.0, 5.0, 10.0, 8.0, 1.0,  8.0});
  const SceneSpec spec = specimen(scenes::squares(10, 10, 3.0, 0.2), dumbbell);
  const Layout layout = layout_of(spec);
  EXPECT_EQ(parts_in(layout), 1U);
  EXPECT_GE(std::ranges::min(layout.joints, {}, [](const Vector2& joint) { return joint.x(); }).x(), 20.0 - 1e-9);
  // In the neck: lines at x of 12, 15 and 18, each of one piece. On the left: lines at x of 3, 6, 9 with pieces 1-3,
  // 3-6, 6-8, and at y of 3 and 6 with 1-3, 3-6, 6-9, 9-10.
  EXPECT_THAT(words_of_walls(spec), HasSubstr("without 20 walls in 4 islands"));
}

TEST(Outline, OfATurnedLatticeFillsTheRectangle) {
  LatticeChanges changes = outlined({10.0, 10.0, 40.0, 30.0});
  changes.rotation_degrees = 30.0;
  const auto scene = scenes::build(specimen(scenes::hexagons(16, 16, 2.0, 0.1), changes));
  ASSERT_TRUE(scene);
  EXPECT_NEAR(scene->length, 30.0, 1e-9);
  EXPECT_NEAR(scene->width, 20.0, 1e-9);
  EXPECT_NEAR(facts_of(*scene).relative_density, 2.0 / std::sqrt(3.0) * 0.1 / 2.0, 0.003);
}

TEST(MadeWalls, HaveTheBitsOfTheirNetwork) {
  LatticeChanges changes = outlined({8.0, 8.0, 40.0, 30.0});
  changes.defects = {0.05, 0.1, 4};
  changes.grading.thickness_steps = {1.0, 2.0};
  changes.rotation_degrees = 12.0;
  SceneSpec spec = specimen(scenes::hexagons(7, 6, 4.0, 0.2), changes);
  spec.imperfection = {.amplitude_mm = 0.01, .seed = 5};
  spec.loading.speed_m_per_s = 50.0;
  SceneSpec network = list_walls(fill_in_fidelity(spec)).spec;
  const auto hash_of_run = [](const SceneSpec& each) {
    Simulation simulation(scenes::build(each));
    simulation.advance(200);
    return scenes::hash_of(simulation.state());
  };
  EXPECT_EQ(hash_of_run(spec), hash_of_run(network));
  SpecChecker checker;
  EXPECT_EQ(checker.check(spec).step_count, checker.check(network).step_count);
  EXPECT_THAT(facts_of(*scenes::build(spec)).modelled, Contains(HasSubstr("turned by 12 degrees; cut at the outline")));
  EXPECT_EQ(facts_of(*scenes::build(spec)).theory.gibson_ashby, 0.0) << "no closed form is known of them";
}

std::vector<std::string> fields_of(const std::function<void(SceneSpec&)>& change) {
  SceneSpec spec = specimen(scenes::hexagons(4, 4, 4.0, 0.2), {});
  change(spec);
  std::vector<std::string> fields;
  for (const Problem& problem : build_scene(spec).problems) fields.push_back(problem.field);
  return fields;
}

TEST(MadeWalls, NameTheFieldsThatAreWrong) {
  EXPECT_THAT(fields_of([](SceneSpec& spec) { spec.changes.defects.missing_walls = 0.6; }),
              ElementsAre("lattice.defects.missing_walls"));
  EXPECT_THAT(fields_of([](SceneSpec& spec) { spec.changes.defects.thickness_scatter = 1.0; }),
              ElementsAre("lattice.defects.thickness_scatter"));
  EXPECT_THAT(fields_of([](SceneSpec& spec) { spec.changes.rotation_degrees = 400.0; }),
              ElementsAre("lattice.rotation_degrees"));
  EXPECT_THAT(fields_of([](SceneSpec& spec) {
                spec.changes.grading.thickness_steps = {1.0, 0.0};
              }),
              ElementsAre("lattice.grading.thickness_steps[1]"));
  EXPECT_THAT(fields_of([](SceneSpec& spec) {
                spec.changes.grading.size_polynomial = {1.0, -1.0};
              }),
              ElementsAre("lattice.grading.size_polynomial"));
  EXPECT_THAT(fields_of([](SceneSpec& spec) {
                spec.changes.grading.size_steps = {1.0};
                spec.changes.grading.size_polynomial = {1.0};
              }),
              ElementsAre("lattice.grading.size_polynomial"));
  EXPECT_THAT(fields_of([](SceneSpec& spec) {
                spec.changes.outline.corners_mm = {0.0, 0.0, 1.0};
              }),
              ElementsAre("lattice.outline.corners_mm"));
  EXPECT_THAT(fields_of([](SceneSpec& spec) {
                spec.changes.outline.corners_mm = {0.0, 0.0, 5.0, 0.0};
              }),
              ElementsAre("lattice.outline.corners_mm"));
  EXPECT_THAT(fields_of([](SceneSpec& spec) {
                spec.changes.outline.corners_mm = {900.0, 900.0, 950.0, 950.0};
              }),
              ElementsAre("lattice.outline.corners_mm"));
  EXPECT_THAT(fields_of([](SceneSpec& spec) {
                spec.changes.defects.missing_walls = 0.1;
                spec.inclusions = {{2}, 2.0};
              }),
              ElementsAre("lattice.inclusions.model"));
  EXPECT_THAT(fields_of([](SceneSpec& spec) {
                spec.changes.defects.missing_walls = 0.1;
                std::get<RegularLattice>(spec.lattice).kind = "sinusoidal_square";
                spec.elements_per_wall = 4;
              }),
              ElementsAre("lattice.sinusoidal_square"));
}

}  // namespace
}  // namespace cellcrush

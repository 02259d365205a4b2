// Drawings of lattices become networks: formats, units, joints.
#include "drawing/drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "drawing/compact_network.h"
#include "drawing/join_walls.h"
#include "drawing/svg_path.h"

namespace cellcrush::drawing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

DrawnWall line(double x1, double y1, double x2, double y2) { return {{x1, y1}, {x2, y2}, 0.0, {}, "line"}; }

JoinedWalls join(std::vector<DrawnWall> walls, JoinOptions options = {}) {
  options.thickness_mm = options.thickness_mm.value_or(0.1);
  return join_walls({std::move(walls), {}, {}}, options);
}

std::vector<double> joints_of(const JoinedWalls& joined) {
  return {joined.network.joints_mm().begin(), joined.network.joints_mm().end()};
}

std::vector<int> walls_of(const JoinedWalls& joined) {
  return {joined.network.walls().begin(), joined.network.walls().end()};
}

TEST(JoinWalls, EndsWithinTheToleranceAreOneJoint) {
  const JoinedWalls joined = join({line(0, 0, 1, 0), line(1.0005, 0, 1, 1)}, JoinOptions{.tolerance_mm = 1e-3});
  EXPECT_THAT(joints_of(joined), ElementsAre(0, 0, 1, 0, 1, 1));
  EXPECT_THAT(walls_of(joined), ElementsAre(0, 1, 1, 2));
  EXPECT_EQ(joined.merged, 1);
  EXPECT_THAT(joined.loose, SizeIs(2));
  EXPECT_THAT(joined.islands, SizeIs(0));
}

/// Walls as thick as `thickness`, bonded; all their numbers, in the order of the walls.
std::vector<double> bonded(std::vector<DrawnWall> walls, double thickness, double share = kBondTolerance) {
  for (DrawnWall& wall : walls) wall.thickness = thickness;
  bond_walls(share, walls);
  std::vector<double> numbers;
  for (const DrawnWall& wall : walls) {
    numbers.insert(numbers.end(), {wall.start.x, wall.start.y, wall.end.x, wall.end.y, *wall.thickness});
  }
  return numbers;
}

TEST(BondWalls, FaceToFaceAreOneWallOfBothThicknesses) {
  const std::vector<DrawnWall> foils = {line(0, 0, 10, 0), line(10, 0.49, 0, 0.49)};
  EXPECT_THAT(bonded(foils, 0.5), ElementsAre(0, 0.245, 10, 0.245, 1.0));
  EXPECT_THAT(bonded(foils, 0.5, 0.0), SizeIs(10));
  EXPECT_THAT(bonded(foils, 0.4), SizeIs(10));                                         // 1.2 thicknesses apart
  EXPECT_THAT(bonded(foils, 0.6), SizeIs(10));                                         // 0.8 of one
  EXPECT_THAT(bonded({line(0, 0, 10, 0), line(9.7, 0.5, 20, 0.5)}, 0.5), SizeIs(10));  // hardly side by side
  EXPECT_THAT(bonded({line(0, 0, 10, 0), line(0, 0.5, 10, 0.6)}, 0.5), SizeIs(10));    // not parallel
  EXPECT_THAT(bonded({line(0, 0, 10, 0), line(0, 0, 10, 0)}, 0.5), SizeIs(10));        // the same place
}

TEST(BondWalls, AStackIsOneWall) {
  EXPECT_THAT(bonded({line(0, 0, 10, 0), line(0, 0.5, 10, 0.5), line(10, 1, 0, 1)}, 0.5),
              ElementsAre(0, 0.5, 10, 0.5, 1.5));
}

TEST(BondWalls, WhatIsBeyondTheBondAndWhatEndsOnItStayJoined) {
  const JoinedWalls joined = join({line(0, 0, 20, 0), line(5, 0.5, 12, 0.5), line(12, 0.5, 20, 8), line(8, 0, 8, -9)},
                                  JoinOptions{.thickness_mm = 0.5});
  EXPECT_THAT(joined.bonds, SizeIs(1));
  EXPECT_EQ(joined.bonds.front().middle, (DrawnPlace{8.5, 0.25}));
  EXPECT_EQ(joined.bonds.front().length, 7.0);
  EXPECT_EQ(joined.bonds.front().thickness, 1.0);
  // From left to right: a single foil, both in two parts, and where they part again two single ones.
  EXPECT_THAT(joints_of(joined), ElementsAre(5, 0.25, 8, 0.25, 12, 0.25, 20, 8, 8, -9, 0, 0, 20, 0));
  EXPECT_THAT(walls_of(joined), ElementsAre(0, 1, 1, 2, 2, 3, 1, 4, 5, 0, 2, 6));
  EXPECT_THAT(joined.network.thicknesses_mm(), ElementsAre(1.0, 1.0, 0.5, 0.5, 0.5, 0.5));
  EXPECT_THAT(joined.islands, SizeIs(0));
  const JoinedWalls sliding = join({line(0, 0, 20, 0), line(5, 0.5, 12, 0.5)}, {.thickness_mm = 0.5, .bond = 0.0});
  EXPECT_THAT(sliding.islands, SizeIs(1));
}

// Foils that meet as the sides of hexagons do, a little out of place: the double walls of an expanded honeycomb.
TEST(BondWalls, ExpandedFoilsBecomeHexagonsWithDoubleWalls) {
  const double slope = 5.0 * std::sqrt(0.75);
  std::vector<DrawnWall> walls;
  for (const int side : {-1, 1}) {
    const double face = 0.05 * side;
    walls.push_back(line(0, face, 5, face));
    walls.push_back(line(5.02, face, 7.5, face + side * slope));
    walls.push_back(line(0, face, -2.5, face + side * slope));
  }
  walls[3] = line(5.03, 0.05, 0.01, 0.05);
  const JoinedWalls joined = join(walls, JoinOptions{.tolerance_mm = 0.04, .thickness_mm = 0.1});
  EXPECT_EQ(joined.network.walls_size() / 2, 5);
  EXPECT_EQ(joined.network.joints_mm_size() / 2, 6);
  EXPECT_THAT(joined.bonds, SizeIs(1));
  EXPECT_EQ(std::ranges::count(joined.network.thicknesses_mm(), 0.2), 1);
  EXPECT_THAT(joined.loose, SizeIs(4));
}

TEST(JoinWalls, AnEndThatMeetsAWallDividesIt) {
  const JoinedWalls joined = join({line(0, 0, 2, 0), line(1, 0, 1, 1)});
  EXPECT_EQ(joined.divided, 1);
  EXPECT_THAT(walls_of(joined), ElementsAre(0, 1, 1, 2, 1, 3));
}

TEST(JoinWalls, WallsThatCrossAreJoinedThereOrNamed) {
  const std::vector<DrawnWall> cross = {line(-1, 0, 1, 0), line(0, -1, 0, 1)};
  EXPECT_THAT(join(cross).crossings, ElementsAre(DrawnPlace{0, 0}));
  EXPECT_EQ(join(cross).network.walls_size() / 2, 4);
  const JoinedWalls kept = join(cross, JoinOptions{.joins_crossings = false});
  EXPECT_THAT(kept.crossings, ElementsAre(DrawnPlace{0, 0}));
  EXPECT_EQ(kept.network.walls_size() / 2, 2);
  EXPECT_THAT(kept.islands, SizeIs(1));
}

TEST(JoinWalls, ThreeWallsThroughAPlaceCrossOnce) {
  const JoinedWalls joined = join({line(-1, 0, 1, 0), line(0, -1, 0, 1), line(-1, -1, 1, 1)});
  EXPECT_EQ(joined.network.joints_mm_size() / 2, 7);
  EXPECT_EQ(joined.network.walls_size() / 2, 6);
}

TEST(JoinWalls, WhatIsThereTwiceOrHasNoLengthIsLeftOut) {
  const JoinedWalls joined = join({line(0, 0, 1, 0), line(1, 0, 0, 0), line(0, 0, 2, 0), line(3, 3, 3, 3)});
  EXPECT_THAT(joined.duplicates, ElementsAre(DrawnPlace{0.5, 0}));
  EXPECT_THAT(joined.covered, ElementsAre(DrawnPlace{0.5, 0}));
  EXPECT_EQ(joined.without_length, 1);
  EXPECT_THAT(walls_of(joined), ElementsAre(0, 1, 1, 2));
}

TEST(JoinWalls, TwoArcsBetweenTheSameJointsAreTwoWalls) {
  DrawnWall up = line(0, 0, 1, 0);
  up.rise = 0.2;
  DrawnWall down = line(1, 0, 0, 0);
  down.rise = 0.2;
  const JoinedWalls joined = join({up, down});
  EXPECT_EQ(joined.network.walls_size() / 2, 2);
  EXPECT_THAT(joined.network.rises_mm(), ElementsAre(0.2, 0.2));
}

DrawnWall arc(double x1, double y1, double x2, double y2, double rise) {
  DrawnWall wall = line(x1, y1, x2, y2);
  wall.rise = rise;
  return wall;
}

TEST(JoinWalls, CollinearWallsThatOverlapAreOneWallThereAndAreNamed) {
  const JoinedWalls joined = join({line(0, 0, 2, 0), line(3, 0, 1, 0)});
  EXPECT_THAT(walls_of(joined), ElementsAre(0, 1, 1, 2, 3, 2));
  EXPECT_THAT(joined.covered, ElementsAre(DrawnPlace{1.5, 0}));
  EXPECT_THAT(joined.duplicates, SizeIs(0));
}

// Half a circle of radius 1 over the origin, from the right; a line through it at a height of 0.6 and a second circle.
TEST(JoinWalls, ArcsAreDividedWhereWallsCrossThem) {
  const JoinedWalls joined = join({arc(1, 0, -1, 0, -1), line(-2, 0.6, 2, 0.6)});
  ASSERT_THAT(joined.crossings, SizeIs(2));
  EXPECT_NEAR(joined.crossings[0].x, -0.8, 1e-12);
  EXPECT_NEAR(joined.crossings[1].x, 0.8, 1e-12);
  ASSERT_EQ(joined.network.walls_size() / 2, 6);
  // The parts of the circle are arcs of it: their rise is that of the chord.
  for (int wall = 0; wall < 3; ++wall) {
    const auto place = [&](int end) {
      const int joint = joined.network.walls(2 * wall + end);
      return DrawnPlace{joined.network.joints_mm(2 * joint), joined.network.joints_mm(2 * joint + 1)};
    };
    const double half = 0.5 * distance(place(0), place(1));
    EXPECT_NEAR(joined.network.rises_mm(wall), -(1.0 - std::sqrt(1.0 - half * half)), 1e-12);
  }
  const JoinedWalls circles = join({arc(1, 0, -1, 0, -1), arc(2, 0, 0, 0, -1)});
  ASSERT_THAT(circles.crossings, SizeIs(1));
  EXPECT_NEAR(circles.crossings[0].x, 0.5, 1e-12);
  EXPECT_NEAR(circles.crossings[0].y, std::sqrt(0.75), 1e-12);
}

TEST(JoinWalls, AnEndOnAnArcDividesIt) {
  const JoinedWalls joined = join({arc(1, 0, -1, 0, -1), line(0, 1, 0, 2)});
  EXPECT_EQ(joined.divided, 1);
  EXPECT_THAT(walls_of(joined), ElementsAre(0, 1, 1, 2, 1, 3));
}

TEST(JoinWalls, ManyWallsThroughAFewPlacesAreRefusedSoon) {
  std::vector<DrawnWall> star;
  for (int i = 0; i < 20000; ++i) star.push_back(line(-1, 1e-4 * i, 1, -1e-4 * i + 1e-5));
  EXPECT_THROW(join(star), DrawingError);
}

TEST(JoinWalls, PlacesThatDoNotFitTheToleranceAreRefused) {
  EXPECT_THROW(join({line(0, 0, 1e-300, 0), line(0, 0, 1e300, 0)}), DrawingError);
  EXPECT_THROW(join({line(0, 0, std::numeric_limits<double>::infinity(), 0)}), DrawingError);
  EXPECT_THROW(join({arc(0, 0, 1, 0, 1.5)}), DrawingError);
}

TEST(JoinWalls, AWallWithoutThicknessIsRefused) {
  EXPECT_THROW(join_walls({{line(0, 0, 1, 0)}, {}, {}}, {}), DrawingError);
}

TEST(CsvDrawing, HasWallsOrNodesAndEdges) {
  const Drawing walls = read_csv_drawing("x1,y1,x2,y2,thickness\n0,0,1,0,0.2\n1,0,1,1,\n", "walls.csv");
  ASSERT_THAT(walls.walls, SizeIs(2));
  EXPECT_EQ(walls.walls[0].thickness, 0.2);
  EXPECT_FALSE(walls.walls[1].thickness);
  const Drawing edges = read_csv_drawing("id;x;y\na;0;0\nb;3;4\n", "n.csv", "start,end\na,b\n", "e.csv");
  ASSERT_THAT(edges.walls, SizeIs(1));
  EXPECT_EQ(distance(edges.walls[0].start, edges.walls[0].end), 5.0);
}

std::string refusal_of(const std::function<void()>& read) {
  try {
    read();
  } catch (const DrawingError& error) {
    return error.what();
  }
  return "";
}

TEST(CsvDrawing, NamesTheLineThatIsWrong) {
  EXPECT_THAT(refusal_of([] { read_csv_drawing("x1,y1,x2,y2\n0,0,1,zero\n", "w.csv"); }),
              HasSubstr("w.csv:2: y2 is \"zero\""));
  EXPECT_THAT(refusal_of([] { read_csv_drawing("x1,y1,x2,y2\n0,0,1\n", "w.csv"); }), HasSubstr("w.csv:2"));
  EXPECT_THAT(refusal_of([] { read_csv_drawing("a,b\n0,0\n", "w.csv"); }), HasSubstr("no column x1"));
}

TEST(JsonDrawing, HasListsOrNodesWithIds) {
  const Drawing lists = read_json_drawing(
      R"({"unit": "cm", "nodes": [[0, 0], [1, 0], [1, 1]], "edges": [[0, 1], [1, 2]], "thickness": [0.1, 0.2]})", "f");
  EXPECT_EQ(lists.mm_per_unit, 10.0);
  ASSERT_THAT(lists.walls, SizeIs(2));
  EXPECT_EQ(lists.walls[1].thickness, 0.2);
  const Drawing graph = read_json_drawing(
      R"({"nodes": [{"id": "a", "x": 0, "y": 0}, {"id": "b", "x": 0, "y": 2}],
          "links": [{"source": "a", "target": "b"}]})",
      "f");
  ASSERT_THAT(graph.walls, SizeIs(1));
  EXPECT_EQ(graph.walls[0].end.y, 2.0);
  EXPECT_THAT(refusal_of([] { read_json_drawing(R"({"nodes": [[0, 0]], "edges": [[0, 7]]})", "f.json"); }),
              HasSubstr("edges[0] names 7"));
}

TEST(DxfDrawing, HasLinesArcsAndBulges) {
  const std::string head = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n5\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n";
  const std::string line_text = "0\nLINE\n8\n0\n10\n0\n20\n0\n11\n3\n21\n4\n";
  const std::string arc = "0\nARC\n8\n0\n10\n0\n20\n0\n40\n2\n50\n0\n51\n90\n";
  const std::string chain = "0\nLWPOLYLINE\n8\n0\n90\n2\n70\n0\n10\n0\n20\n0\n42\n1\n10\n2\n20\n0\n";
  const Drawing drawing = read_dxf_drawing(head + line_text + arc + chain + "0\nENDSEC\n0\nEOF\n", "f.dxf");
  EXPECT_EQ(drawing.mm_per_unit, 10.0);
  ASSERT_THAT(drawing.walls, SizeIs(3));
  EXPECT_EQ(distance(drawing.walls[0].start, drawing.walls[0].end), 5.0);
  // A quarter of a circle of radius 2, counterclockwise: it bulges to the right.
  EXPECT_NEAR(drawing.walls[1].rise, -2.0 * (1.0 - std::sqrt(0.5)), 1e-12);
  // Bulge 1 is half a circle, counterclockwise.
  EXPECT_NEAR(drawing.walls[2].rise, -1.0, 1e-12);
}

TEST(SvgDrawing, HasShapesWithTransformsAndTheSizeOfTheFile) {
  const Drawing drawing = read_svg_drawing(
      R"svg(<svg xmlns="http://www.w3.org/2000/svg" width="100mm" viewBox="0 0 200 200">
           <g transform="translate(10 0) scale(2)" stroke-width="0.5"><line x1="0" y1="0" x2="5" y2="0"/></g>
           <path d="M0 0h2v3"/><circle cx="1" cy="1" r="1"/><text>note</text></svg>)svg",
      "f.svg");
  EXPECT_EQ(drawing.mm_per_unit, 0.5);
  ASSERT_THAT(drawing.walls, SizeIs(7));
  EXPECT_EQ(drawing.walls[0].start, (DrawnPlace{10.0, 0.0}));
  EXPECT_EQ(drawing.walls[0].end, (DrawnPlace{20.0, 0.0}));
  EXPECT_EQ(drawing.walls[0].thickness, 1.0);
  EXPECT_EQ(drawing.walls[2].end, (DrawnPlace{2.0, -3.0})) << "y points down in a file";
  EXPECT_THAT(drawing.left_out, ElementsAre("1 text"));
}

TEST(SvgPath, CurvesEndWhereTheyShouldAndLieOnTheirCircle) {
  const auto chains = flatten_svg_path("M1,0A1 1 0 0 1 0 1C0 2 1 3 2 3");
  ASSERT_THAT(chains, SizeIs(1));
  ASSERT_THAT(chains[0], SizeIs(33));
  for (int i = 0; i <= 16; ++i) EXPECT_NEAR(std::hypot(chains[0][i].x, chains[0][i].y), 1.0, 1e-12);
  EXPECT_EQ(chains[0].back(), (DrawnPlace{2.0, 3.0}));
}

TEST(SvgDrawing, RefusesGroupsThatAreNestedTooDeep) {
  std::string text = "<svg>";
  for (int i = 0; i < 100000; ++i) text += "<g>";
  for (int i = 0; i < 100000; ++i) text += "</g>";
  EXPECT_THAT(refusal_of([&] { read_svg_drawing(text + "</svg>", "f.svg"); }), HasSubstr("nested"));
}

TEST(DxfDrawing, RefusesAnEntityThatCountsMoreThanTheFileHas) {
  const std::string chain = "0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\n0\n90\n500000000\n70\n0\n10\n0\n20\n0\n";
  EXPECT_THAT(refusal_of([&] { read_dxf_drawing(chain + "0\nENDSEC\n0\nEOF\n", "f.dxf"); }),
              HasSubstr("f.dxf:10: LWPOLYLINE says that it has 500000000 parts"));
}

TEST(Arcs, OfAnyAnglesAreOneTurnAtMost) {
  EXPECT_THAT(walls_of_arc({0, 0}, 1.0, 1e300, 0.0, "ARC 1"), SizeIs(::testing::Le(4)));
  EXPECT_THROW(walls_of_arc({0, 0}, 1.0, 0.0, std::numeric_limits<double>::infinity(), "ARC 1"), DrawingError);
}

TEST(MeshDrawing, RefusesCountsThatAreNone) {
  const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
  EXPECT_THAT(refusal_of([&] { read_gmsh_drawing(head + "$Nodes\n\n", "f.msh"); }), HasSubstr("f.msh:5"));
  EXPECT_THAT(refusal_of([&] { read_gmsh_drawing(head + "$Elements\n1\n1 1 -1e300 0 1 1 2\n", "f.msh"); }),
              HasSubstr("is no whole number"));
}

TEST(MeshDrawing, OfAbaqusHasBeamsWithTheThicknessOfTheirSection) {
  const Drawing drawing = read_abaqus_drawing(
      "*Heading\n*Node\n 1, 0., 0.\n 2, 1., 0.\n 3, 1., 1.\n*Element, type=B21, elset=Walls\n 1, 1, 2\n 2, 2, 3\n"
      "*Element, type=CPS4\n 3, 1, 2, 3, 3\n*Beam Section, elset=Walls, material=Al, section=RECT\n 10., 0.3\n",
      "f.inp");
  ASSERT_THAT(drawing.walls, SizeIs(2));
  EXPECT_EQ(drawing.walls[1].thickness, 0.3);
}

TEST(MeshDrawing, OfGmshHasItsLinesOfBothVersions) {
  const Drawing old = read_gmsh_drawing(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n2\n1 0 0 0\n2 3 4 0\n$EndNodes\n$Elements\n1\n1 1 2 0 1 1 2\n"
      "$EndElements\n",
      "f.msh");
  ASSERT_THAT(old.walls, SizeIs(1));
  const Drawing now = read_gmsh_drawing(
      "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 2 1 2\n1 1 0 2\n1\n2\n0 0 0\n3 4 0\n$EndNodes\n$Elements\n"
      "1 1 1 1\n1 1 1 1\n1 1 2\n$EndElements\n",
      "f.msh");
  ASSERT_THAT(now.walls, SizeIs(1));
  EXPECT_EQ(distance(now.walls[0].start, now.walls[0].end), 5.0);
}

v1::Lattice::Network two_walls(double far) {
  v1::Lattice::Network out;
  for (const double number : {0.5, -1.25, far, -1.25, far, 3.0}) out.add_joints_mm(number);
  for (const int joint : {0, 1, 2, 1}) out.add_walls(joint);
  for (const double thickness : {0.1, 0.25}) out.add_thicknesses_mm(thickness);
  return out;
}

TEST(CompactNetwork, CountsStepsFromNumberToNumber) {
  v1::Lattice::Network network = two_walls(10.1);
  ASSERT_TRUE(make_compact(network, Rounding::none));
  EXPECT_EQ(network.compact().steps_per_mm(), 100) << "the fewest that keep two decimals";
  EXPECT_THAT(network.compact().joint_differences(), ElementsAre(50, -125, 960, 0, 0, 425));
  EXPECT_THAT(network.compact().wall_differences(), ElementsAre(0, 1, 1, -1));
  EXPECT_THAT(network.compact().thicknesses(), ElementsAre(10, 25));
  EXPECT_FALSE(make_compact(network, Rounding::none)) << "It is compact.";
}

TEST(CompactNetwork, RoundsOnlyWhatMayBeRounded) {
  for (const double far : {10.0 / 3.0, 1e300, std::numeric_limits<double>::quiet_NaN()}) {
    v1::Lattice::Network network = two_walls(far);
    EXPECT_FALSE(make_compact(network, Rounding::none)) << far;
    EXPECT_THAT(network.joints_mm(), SizeIs(6)) << far;
    EXPECT_EQ(make_compact(network, Rounding::to_a_step), far < 1e6) << far;
  }
  v1::Lattice::Network wide = two_walls(1e5 / 3.0);
  ASSERT_TRUE(make_compact(wide, Rounding::to_a_step));
  EXPECT_EQ(wide.compact().steps_per_mm(), 10'000) << "Differences have 32 bits.";
  v1::Lattice::Network thin = two_walls(10.0 / 3.0);
  thin.set_thicknesses_mm(0, 1e-7);
  EXPECT_FALSE(make_compact(thin, Rounding::to_a_step)) << "No wall loses its thickness.";
}

}  // namespace
}  // namespace cellcrush::drawing

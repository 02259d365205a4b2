#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "contact/topology/face_loops.h"
#include "contact/topology/wall_paths.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"

namespace cellcrush {
namespace {

using Premise = ContactFaces::Premise;
using scenes::beam;

/// A frame of beams that may touch each other.
std::shared_ptr<Scene> frame_of(const std::vector<Vector2>& nodes, const std::vector<std::pair<int, int>>& beams) {
  FrameLattice frame;
  for (const Vector2& node : nodes) {
    frame.nodes.push_back({node.x(), node.y(), 0.0, 0.0});
  }
  for (const auto& [start, end] : beams) {
    frame.beams.push_back(beam(start, end, 0.5, 2));
  }
  frame.self_contact = true;
  return scenes::build(scenes::elastic_frame(frame));
}

const std::vector<Vector2> kSquare = {{0, 0}, {20, 0}, {20, 20}, {0, 20}};
const std::vector<std::pair<int, int>> kRing = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};

TEST(ContactFaces, OfASpecimenAreItsCellsAndTheOuterBorder) {
  const auto scene = scenes::build(scenes::hexagon_specimen(7, 4));
  ASSERT_TRUE(scene->faces.are_enough());
  const FacesOfBand& faces = scene->faces.bands.front();
  EXPECT_EQ(faces.count(), 7 + 6 + 7 + 6 + 1);
  EXPECT_EQ(faces.particle.size(), 2 * scene->element_count());  // each element has two sides
  for (int face = 0; face + 1 < faces.count(); ++face) {
    EXPECT_EQ(faces.corner_count(face), 12);
  }
}

TEST(ContactFaces, EveryElementHasAFaceAtEitherSideThatItBorders) {
  const auto scene = scenes::build(scenes::hexagon_specimen(5, 4));
  const FacesOfBand& faces = scene->faces.bands.front();
  for (std::size_t e = 0; e < scene->element_count(); ++e) {
    EXPECT_NE(scene->faces.side[2 * e], scene->faces.side[2 * e + 1]);
    for (const int face : {scene->faces.side[2 * e], scene->faces.side[2 * e + 1]}) {
      const auto first = faces.element.begin() + faces.offset[face];
      EXPECT_EQ(std::count(first, first + faces.corner_count(face), static_cast<int>(e)), 1);
    }
  }
}

// Each of the 30 vertical walls stands out at both ends, but at the 10 ends where it meets one other wall only.
TEST(ContactFaces, OfThickWallsHaveTheirEnds) {
  SceneSpec spec = scenes::hexagon_specimen(7, 4);
  scenes::cells_of(spec).own["vertical_wall_thickness_mm"] = 0.5;
  const auto scene = scenes::build(spec);
  const FacesOfBand& faces = scene->faces.bands.front();
  std::size_t count = 0;
  for (int face = 0; face < faces.count(); ++face) {
    for (int k = faces.corner_end[face]; k < faces.offset[face + 1]; ++k) {
      const Element& thick = scene->elements[faces.element[k]];
      EXPECT_EQ(thick.thickness, 0.5);
      EXPECT_TRUE(thick.start == faces.particle[k] || thick.end == faces.particle[k]);
      const int corner = thick.start == faces.particle[k] ? thick.end : thick.start;
      const auto corners = faces.particle.begin();
      EXPECT_EQ(std::count(corners + faces.offset[face], corners + faces.corner_end[face], corner), 1);
      EXPECT_EQ(std::count(corners + faces.offset[face], corners + faces.corner_end[face], faces.particle[k]), 0);
      ++count;
    }
  }
  EXPECT_EQ(count, scene->faces.thick_ends.size());
  EXPECT_EQ(count, 2u * 30u - 10u);
}

TEST(ContactFaces, AreEnoughForARingOfBeams) { EXPECT_TRUE(frame_of(kSquare, kRing)->faces.are_enough()); }

TEST(ContactFaces, AreNotEnoughForATreeABridgeOrAWallThatEndsInAFace) {
  EXPECT_EQ(frame_of(kSquare, {{0, 1}, {1, 2}, {1, 3}})->faces.premise, Premise::not_closed);
  auto nodes = kSquare;
  auto beams = kRing;
  nodes.emplace_back(8, 9);
  beams.emplace_back(0, 4);
  EXPECT_EQ(frame_of(nodes, beams)->faces.premise, Premise::not_closed);
  // Two rings that share one particle only.
  const std::vector<std::pair<int, int>> two_rings = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {2, 4}, {4, 5}, {5, 2}};
  EXPECT_EQ(frame_of({{0, 0}, {20, 0}, {20, 20}, {0, 20}, {40, 20}, {30, 40}}, two_rings)->faces.premise,
            Premise::not_closed);
}

TEST(ContactFaces, AreNotEnoughForTwoParts) {
  auto nodes = kSquare;
  auto beams = kRing;
  nodes.insert(nodes.end(), {{5, 5}, {15, 5}, {10, 15}});
  beams.insert(beams.end(), {{4, 5}, {5, 6}, {6, 4}});
  const auto scene = frame_of(nodes, beams);
  EXPECT_EQ(scene->faces.premise, Premise::several_parts);
  EXPECT_TRUE(scene->faces.bands.empty());
}

// Input whose walls cross is refused where there is contact; should such a scene ever be built, Euler's formula tells.
TEST(ContactFaces, AreNotEnoughWhereElementsCrossWithoutAParticle) {
  Scene scene;
  scene.position = kSquare;
  for (const auto& [start, end] : std::vector<std::pair<int, int>>{{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 2}, {1, 3}}) {
    scene.elements.push_back({start, end, 0.5, 0});
  }
  scene.incidence_offset = {0, 3, 6, 9, 12};
  scene.incidence = {0, 3, 4, 0, 1, 5, 1, 2, 4, 2, 3, 5};
  build_contact_faces(scene);
  EXPECT_EQ(scene.faces.premise, Premise::not_planar);
}

TEST(ContactFaces, AreLeftOutWhereNotAskedFor) {
  SceneSpec spec = scenes::hexagon_specimen(4, 3);
  spec.contact.search = ContactSpec::Search::buckets;
  EXPECT_EQ(scenes::build(spec)->faces.premise, Premise::not_asked);
}

// The table that the searches read against the walk from each ball, on walls as thick as their elements are long.
TEST(LimitedReaches, AreThoseOfTheWalkAlongTheWalls) {
  SceneSpec spec = scenes::hexagon_specimen(3, 2);
  spec.elements_per_wall = 8;
  const auto scene = scenes::build(spec);
  WallPaths paths(*scene);
  int limited = 0;
  for (int ball = 0; ball < static_cast<int>(scene->particle_count()); ++ball) {
    for (int e = 0; e < static_cast<int>(scene->element_count()); ++e) {
      const Element& element = scene->elements[e];
      if (ball != element.start && ball != element.end) {
        ASSERT_EQ(scene->reach_of(ball, e), paths.reach_of(ball, e)) << ball << " " << e;
        const double most = kMostThickening * scene->full_reach_of(ball, e);
        const bool is_limited = paths.limit_of(ball, e, most) < most;
        ASSERT_EQ(is_limited, std::isfinite(scene->most_reach_of(ball, e))) << ball << " " << e;
        limited += is_limited ? 1 : 0;
      }
    }
  }
  EXPECT_EQ(limited, static_cast<int>(scene->limited_reaches.segment.size()));
  EXPECT_GT(limited, 100);
}

}  // namespace
}  // namespace cellcrush

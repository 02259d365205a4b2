// How a large lattice is cut into bands.
#include "contact/topology/bands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <tuple>
#include <vector>

#include "lattice/lattice.h"
#include "scenes/crushes.h"
#include "scenes/frames.h"
#include "scenes/lattices.h"

namespace cellcrush {
namespace {

SceneSpec wide_specimen() { return scenes::with_the_papers_elements(scenes::hexagon_specimen(10, 1000)); }

TEST(Bands, HaveWallsAndFacesWithTheirNeighboursOnly) {
  const auto scene = scenes::build(wide_specimen());
  const std::vector<int> band_of = bands_of_particles(*scene, scene->bands);
  for (std::size_t b = 0; b < scene->bands.size(); ++b) {
    const LatticeBand& band = scene->bands[b];
    for (int k = scene->walls.chunk_offset[band.first_chunk]; k < scene->walls.chunk_offset[band.end_chunk]; ++k) {
      const WallBlock& block = scene->walls.blocks[k];
      for (int wall = block.first_wall; wall < block.first_wall + block.walls; ++wall) {
        for (const int joint : {scene->walls.start[wall], scene->walls.end[wall]}) {
          ASSERT_LE(band_of[joint], static_cast<int>(b));
          ASSERT_GE(band_of[joint], static_cast<int>(b) - 1);
        }
      }
    }
    for (const int particle : scene->faces.bands[b].particle) {
      ASSERT_LE(std::abs(band_of[particle] - static_cast<int>(b)), 1);
    }
  }
}

TEST(Bands, HaveEveryFaceOnceAndABallsInItsOwnOrTheOneBefore) {
  const auto scene = scenes::build(wide_specimen());
  const std::vector<int> band_of = bands_of_particles(*scene, scene->bands);
  std::vector<std::set<int>> elements_of(scene->bands.size());
  std::set<int> taken;
  for (std::size_t b = 0; b < scene->bands.size(); ++b) {
    const FacesOfBand& faces = scene->faces.bands[b];
    EXPECT_FALSE(faces.is_outer_whole);
    EXPECT_TRUE(std::is_sorted(faces.number.begin(), faces.number.end()));
    for (int face = 0; face + 1 < faces.count(); ++face) {  // the last one is the outer
      EXPECT_TRUE(taken.insert(faces.number[face]).second);
      for (int k = faces.offset[face]; k < faces.offset[face + 1]; ++k) {
        const int ahead = band_of[faces.particle[k]] - static_cast<int>(b);
        ASSERT_TRUE(ahead == 0 || ahead == 1) << ahead;
      }
    }
    elements_of[b].insert(faces.element.begin(), faces.element.end());
    EXPECT_EQ(faces.group_offset.front(), 0);
    EXPECT_EQ(faces.group_offset.back(), faces.count());
  }
  EXPECT_EQ(taken.size() + scene->particle_count(), scene->element_count() + 1)
      << "Euler's formula, without the outer face";
  for (std::size_t e = 0; e < scene->element_count(); ++e) {
    for (const int particle : {scene->elements[e].start, scene->elements[e].end}) {
      const int band = band_of[particle];
      ASSERT_TRUE(elements_of[band].count(static_cast<int>(e)) > 0 ||
                  (band > 0 && elements_of[band - 1].count(static_cast<int>(e)) > 0));
    }
  }
}

TEST(Bands, AreOfLongLatticesAndOfSquaresAndTrianglesToo) {
  const SceneSpec hexagons = wide_specimen();
  SceneSpec squares = hexagons;
  squares.lattice = scenes::squares(12, 1500, 4.0, 0.3);
  SceneSpec triangles = hexagons;
  triangles.lattice = scenes::triangles(10, 1000, 4.0, 0.2);
  for (const SceneSpec& spec :
       {scenes::hexagon_specimen(1000, 10), scenes::hexagon_specimen(130, 100), squares, triangles}) {
    const auto scene = scenes::build(spec);
    EXPECT_GT(scene->element_count(), kLeastElementsOfBands);
    EXPECT_GT(scene->bands.size(), 10u);
  }
}

TEST(Bands, AreLeftOutWhereTheyDoNotPayOrAreNotEnough) {
  const auto bands_of = [](const SceneSpec& spec) { return scenes::build(spec)->bands.size(); };
  EXPECT_EQ(bands_of(scenes::hexagon_specimen(12, 5)), 1u);
  SceneSpec spec = wide_specimen();
  spec.contact.friction = 0.2;
  EXPECT_EQ(bands_of(spec), 1u) << "friction is handed over between balls of two bands";
  spec = wide_specimen();
  spec.contact.search = ContactSpec::Search::buckets;
  EXPECT_EQ(bands_of(spec), 1u);
}

/// A wall, by where it begins and ends and its thickness.
using PlacedWall = std::tuple<double, double, double, double, double>;

std::vector<PlacedWall> walls_of(const Layout& layout) {
  std::vector<PlacedWall> walls;
  for (const LayoutWall& wall : layout.walls) {
    const Vector2& start = layout.joints[wall.start];
    const Vector2& end = layout.joints[wall.end];
    walls.emplace_back(start.x(), start.y(), end.x(), end.y(), wall.thickness);
  }
  std::sort(walls.begin(), walls.end());
  return walls;
}

TEST(NumberColumns, GoesAlongALongLatticeAndChangesNothingElse) {
  SceneSpec spec = scenes::hexagon_specimen(1000, 10);
  spec.elements_per_wall = 4;
  const Layout rows = kind_of(spec)->lay_out(spec);
  Layout columns = rows;
  number_columns(rows.joints, columns);
  EXPECT_TRUE(std::is_sorted(columns.joints.begin(), columns.joints.end(),
                             [](const Vector2& a, const Vector2& b) { return a.x() < b.x(); }));
  EXPECT_FALSE(std::is_sorted(rows.joints.begin(), rows.joints.end(),
                              [](const Vector2& a, const Vector2& b) { return a.x() < b.x(); }));
  EXPECT_EQ(walls_of(columns), walls_of(rows));
  for (std::size_t w = 1; w < columns.walls.size(); ++w) {
    ASSERT_LE(std::min(columns.walls[w - 1].start, columns.walls[w - 1].end),
              std::min(columns.walls[w].start, columns.walls[w].end));
  }
}

TEST(NumberColumns, LeavesWideAndSmallOnesAsTheyAre) {
  for (SceneSpec spec : {wide_specimen(), scenes::hexagon_specimen(100, 10)}) {
    spec.elements_per_wall = 4;
    const Layout rows = kind_of(spec)->lay_out(spec);
    Layout columns = rows;
    number_columns(rows.joints, columns);
    EXPECT_EQ(columns.joints, rows.joints);
  }
}

}  // namespace
}  // namespace cellcrush

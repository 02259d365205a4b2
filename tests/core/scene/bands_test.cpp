// How a large lattice is cut into bands.
#include "scene/bands.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <set>
#include <vector>

#include "scenes/crushes.h"
#include "scenes/frames.h"

namespace cellcrush {
namespace {

SceneSpec wide_block() { return scenes::with_the_papers_elements(scenes::hexagon_block(10, 1000)); }

TEST(Bands, FollowEachOtherAndHaveAll) {
  const auto scene = scenes::build(wide_block());
  const std::vector<LatticeBand>& bands = scene->bands;
  ASSERT_GT(bands.size(), 10u);
  EXPECT_EQ(scene->faces.bands.size(), bands.size());
  for (std::size_t b = 0; b < bands.size(); ++b) {
    EXPECT_EQ(bands[b].first_chunk, b > 0 ? bands[b - 1].end_chunk : 0);
    EXPECT_EQ(bands[b].first_joint, b > 0 ? bands[b - 1].end_joint : 0);
    EXPECT_EQ(bands[b].first_inner, b > 0 ? bands[b - 1].end_inner : scene->joint_count);
    EXPECT_LT(bands[b].first_chunk, bands[b].end_chunk);
  }
  EXPECT_EQ(bands.back().end_chunk, scene->walls.chunk_count());
  EXPECT_EQ(bands.back().end_joint, scene->joint_count);
  EXPECT_EQ(bands.back().end_inner, static_cast<int>(scene->particle_count()));
}

TEST(Bands, HaveWallsAndFacesWithTheirNeighboursOnly) {
  const auto scene = scenes::build(wide_block());
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

TEST(Bands, HaveAllFacesOfTheirBallsOnce) {
  const auto scene = scenes::build(wide_block());
  const std::vector<int> band_of = bands_of_particles(*scene, scene->bands);
  std::vector<std::set<int>> elements_of(scene->bands.size());
  for (std::size_t b = 0; b < scene->bands.size(); ++b) {
    const FacesOfBand& faces = scene->faces.bands[b];
    EXPECT_FALSE(faces.is_outer_whole);
    EXPECT_TRUE(std::is_sorted(faces.number.begin(), faces.number.end()));
    EXPECT_EQ(std::set<int>(faces.number.begin(), faces.number.end()).size(), faces.number.size());
    elements_of[b].insert(faces.element.begin(), faces.element.end());
    EXPECT_EQ(faces.group_offset.front(), 0);
    EXPECT_EQ(faces.group_offset.back(), faces.count());
  }
  // Of every ball, what borders its faces is in its band; so are its own elements.
  for (std::size_t e = 0; e < scene->element_count(); ++e) {
    for (const int particle : {scene->elements[e].start, scene->elements[e].end}) {
      ASSERT_EQ(elements_of[band_of[particle]].count(static_cast<int>(e)), 1u);
    }
  }
}

TEST(Bands, AreLeftOutWhereTheyDoNotPayOrAreNotEnough) {
  const auto bands_of = [](SceneSpec spec) { return scenes::build(spec)->bands.size(); };
  EXPECT_EQ(bands_of(scenes::hexagon_block(12, 5)), 1u);
  SceneSpec spec = wide_block();
  spec.contact.friction = 0.2;
  EXPECT_EQ(bands_of(spec), 1u) << "friction is handed over between balls of two bands";
  spec = wide_block();
  spec.contact.search = ContactSpec::Search::buckets;
  EXPECT_EQ(bands_of(spec), 1u);
}

}  // namespace
}  // namespace cellcrush

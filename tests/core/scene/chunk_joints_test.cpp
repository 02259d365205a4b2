#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "cellcrush/scene.h"
#include "scenes/frames.h"
#include "scenes/presets.h"

namespace cellcrush {
namespace {

/// Of every joint, the chunks of its walls.
std::vector<std::vector<int>> chunks_of_joints(const Scene& scene) {
  std::vector<std::vector<int>> chunks(scene.joint_count);
  for (int chunk = 0; chunk < scene.walls.chunk_count(); ++chunk) {
    for (int b = scene.walls.chunk_offset[chunk]; b < scene.walls.chunk_offset[chunk + 1]; ++b) {
      const WallBlock& block = scene.walls.blocks[b];
      for (int wall = block.first_wall; wall < block.first_wall + block.walls; ++wall) {
        chunks[scene.walls.start[wall]].push_back(chunk);
        chunks[scene.walls.end[wall]].push_back(chunk);
      }
    }
  }
  return chunks;
}

/// Checks by every joint what is said of every chunk, and that most joints are said to belong to one thread of four.
void check_joints_of_chunks(const Scene& scene) {
  const auto chunks = chunks_of_joints(scene);
  const Walls& walls = scene.walls;
  ASSERT_GE(walls.chunk_count(), 4);
  EXPECT_EQ(walls.first_joint.front(), 0);
  EXPECT_EQ(walls.end_joint.back(), scene.joint_count);
  for (int joint = 0; joint < scene.joint_count; ++joint) {
    for (const int of_wall : chunks[joint]) {
      for (int chunk = 0; chunk < walls.chunk_count(); ++chunk) {
        EXPECT_FALSE(of_wall < chunk && joint >= walls.first_joint[chunk]) << joint << " has a wall before " << chunk;
        EXPECT_FALSE(of_wall > chunk && joint < walls.end_joint[chunk]) << joint << " has a wall after " << chunk;
      }
    }
  }
  for (int part = 1; part < 4; ++part) {
    const int chunk = walls.chunk_count() * part / 4;
    EXPECT_LE(walls.end_joint[chunk - 1], walls.first_joint[chunk]) << "no joint belongs to two";
    EXPECT_LT(walls.first_joint[chunk] - walls.end_joint[chunk - 1], scene.joint_count / 8) << part;
  }
}

TEST(ChunkJoints, AreThoseWithoutWallsElsewhere) {
  for (const char* name : {"type-i", "type-ii-as-counted", "type-iii-as-counted"}) {
    SCOPED_TRACE(name);
    check_joints_of_chunks(*scenes::build(scenes::preset(name)));
  }
}

TEST(ChunkJoints, HoldForJointsInsideRigidBodiesWhichHaveNoWalls) {
  const auto scene = scenes::build(scenes::preset("inclusions-2"));
  const auto chunks = chunks_of_joints(*scene);
  ASSERT_TRUE(std::any_of(chunks.begin(), chunks.end(), [](const auto& of_joint) { return of_joint.empty(); }));
  const Walls& walls = scene->walls;
  for (int chunk = 1; chunk < walls.chunk_count(); ++chunk) {
    EXPECT_LE(walls.end_joint[chunk - 1], walls.first_joint[chunk]) << "no joint belongs to two";
  }
  EXPECT_EQ(walls.end_joint.back(), scene->joint_count);
}

}  // namespace
}  // namespace cellcrush

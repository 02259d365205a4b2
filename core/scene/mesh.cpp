#include "scene/mesh.h"

#include <algorithm>
#include <cstddef>

namespace cellcrush {
namespace {

/// Number of walls from `first` on, before `end`, that go into one block.
int walls_in_block(const Layout& layout, std::size_t first, std::size_t end) {
  int count = 0;
  for (std::size_t w = first;
       w < end && count < kMostWallsInBlock && layout.walls[w].elements == layout.walls[first].elements; ++w) {
    ++count;
  }
  return count;
}

void divide_block(const Layout& layout, const WallBlock& block, Scene& scene) {
  const auto inner = [&](int j, int w) { return block.first_inner + j * block.walls + w; };
  for (int j = 0; j < block.elements; ++j) {
    for (int w = 0; w < block.walls; ++w) {
      const LayoutWall& wall = layout.walls[block.first_wall + w];
      const bool is_last = j + 1 == block.elements;
      scene.elements.push_back(
          {j == 0 ? wall.start : inner(j - 1, w), is_last ? wall.end : inner(j, w), wall.thickness, wall.material});
      if (!is_last) {
        const Vector2& from = layout.joints[wall.start];
        const double share = static_cast<double>(j + 1) / wall.elements;
        scene.position.emplace_back(from + (layout.joints[wall.end] - from) * share);
      }
    }
  }
}

/// Groups adjacent blocks that are all full, or all not full, into chunks.
std::vector<int> chunk_offsets(const std::vector<WallBlock>& blocks) {
  std::vector<int> offsets = {0};
  int elements = 0;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const int more = blocks[i].walls * blocks[i].elements;
    const bool is_alike =
        i == 0 || (blocks[i].walls == kMostWallsInBlock) == (blocks[i - 1].walls == kMostWallsInBlock);
    if (elements > 0 && (elements + more > kElementsInChunk || !is_alike)) {
      offsets.push_back(static_cast<int>(i));
      elements = 0;
    }
    elements += more;
  }
  offsets.push_back(static_cast<int>(blocks.size()));
  return offsets;
}

/// Calls visit(chunk, joint) for every end of a wall, chunks ascending.
template <class Visit>
void visit_chunk_joints(const Walls& walls, Visit&& visit) {
  for (int chunk = 0; chunk < walls.chunk_count(); ++chunk) {
    for (int b = walls.chunk_offset[chunk]; b < walls.chunk_offset[chunk + 1]; ++b) {
      const WallBlock& block = walls.blocks[b];
      for (int wall = block.first_wall; wall < block.first_wall + block.walls; ++wall) {
        visit(chunk, walls.start[wall]);
        visit(chunk, walls.end[wall]);
      }
    }
  }
}

/// Fills first_joint and end_joint of every chunk. A joint without walls belongs to the chunk of its neighbour.
void order_joints(Walls& walls, int joint_count) {
  constexpr int kNone = -1;
  std::vector<int> first(joint_count, kNone);
  std::vector<int> last(joint_count, kNone);
  visit_chunk_joints(walls, [&](int chunk, int joint) {
    first[joint] = first[joint] == kNone ? chunk : first[joint];
    last[joint] = chunk;
  });
  walls.first_joint.assign(walls.chunk_count(), 0);
  walls.end_joint.assign(walls.chunk_count(), joint_count);
  for (int joint = 0; joint < joint_count; ++joint) {
    if (first[joint] == kNone) {
      first[joint] = last[joint] = joint == 0 ? 0 : last[joint - 1];
    }
    if (first[joint] + 1 < walls.chunk_count()) {
      walls.first_joint[first[joint] + 1] = joint + 1;
    }
    if (last[joint] > 0) {
      walls.end_joint[last[joint] - 1] = std::min(walls.end_joint[last[joint] - 1], joint);
    }
  }
  for (int chunk = 1; chunk < walls.chunk_count(); ++chunk) {
    walls.first_joint[chunk] = std::max(walls.first_joint[chunk], walls.first_joint[chunk - 1]);
  }
  for (int chunk = walls.chunk_count() - 2; chunk >= 0; --chunk) {
    walls.end_joint[chunk] = std::min(walls.end_joint[chunk], walls.end_joint[chunk + 1]);
  }
}

}  // namespace

void divide_walls(const Layout& layout, Scene& scene) {
  std::size_t elements = 0;
  for (const LayoutWall& wall : layout.walls) {
    elements += static_cast<std::size_t>(wall.elements);
  }
  scene.elements.reserve(elements);
  scene.position.reserve(layout.joints.size() + elements - layout.walls.size());
  scene.position.assign(layout.joints.begin(), layout.joints.end());
  scene.joint_count = static_cast<int>(layout.joints.size());
  const auto rigid =
      std::find_if(layout.walls.begin(), layout.walls.end(), [](const LayoutWall& wall) { return wall.rigid; });
  const auto count = static_cast<std::size_t>(rigid - layout.walls.begin());
  for (std::size_t w = 0; w < count;) {
    const WallBlock block = {static_cast<int>(w), walls_in_block(layout, w, count), layout.walls[w].elements,
                             static_cast<int>(scene.elements.size()), static_cast<int>(scene.position.size())};
    divide_block(layout, block, scene);
    scene.walls.blocks.push_back(block);
    w += static_cast<std::size_t>(block.walls);
  }
  scene.walls.chunk_offset = chunk_offsets(scene.walls.blocks);
  for (auto wall = layout.walls.begin(); wall != rigid; ++wall) {
    const double length = (layout.joints[wall->end] - layout.joints[wall->start]).norm();
    scene.walls.start.push_back(wall->start);
    scene.walls.end.push_back(wall->end);
    scene.walls.thickness.push_back(wall->thickness);
    scene.walls.undeformed_length.push_back(length / wall->elements);
    scene.walls.material.push_back(wall->material);
  }
  order_joints(scene.walls, scene.joint_count);
  scene.rigid.first_element = static_cast<int>(scene.elements.size());
  for (auto wall = rigid; wall != layout.walls.end(); ++wall) {
    scene.elements.push_back({wall->start, wall->end, wall->thickness, wall->material});
  }
}

}  // namespace cellcrush

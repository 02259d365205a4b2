#include "scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

namespace cellcrush {
namespace {

/// Position at a share of a wall, which is bowed to half a sine wave.
Vector2 place_on(const Layout& layout, const LayoutWall& wall, double share) {
  const Vector2& from = layout.joints[wall.start];
  const Vector2 along = layout.joints[wall.end] - from;
  const Vector2 straight = from + along * share;
  if (wall.bow == 0.0) {
    return straight;
  }
  const Vector2 to_the_left = Vector2(-along.y(), along.x()).normalized();
  return straight + wall.bow * std::sin(std::numbers::pi * share) * to_the_left;
}

/// Length of a wall along its elements.
double length_of(const Layout& layout, const LayoutWall& wall) {
  if (wall.bow == 0.0) {
    return (layout.joints[wall.end] - layout.joints[wall.start]).norm();
  }
  double length = 0.0;
  for (int j = 0; j < wall.elements; ++j) {
    const auto place_at = [&](int i) { return place_on(layout, wall, static_cast<double>(i) / wall.elements); };
    length += (place_at(j + 1) - place_at(j)).norm();
  }
  return length;
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
        scene.position.push_back(place_on(layout, wall, static_cast<double>(j + 1) / wall.elements));
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

/// Fills first_joint and end_joint of every chunk, so that the former is not before the latter of the chunk before.
void order_joints(Walls& walls, int joint_count) {
  const int count = walls.chunk_count();
  std::vector<int> lowest(count, joint_count);
  std::vector<int> highest(count, -1);
  for (int chunk = 0; chunk < count; ++chunk) {
    const WallBlock& last = walls.blocks[walls.chunk_offset[chunk + 1] - 1];
    for (int wall = walls.blocks[walls.chunk_offset[chunk]].first_wall; wall < last.first_wall + last.walls; ++wall) {
      lowest[chunk] = std::min({lowest[chunk], walls.start[wall], walls.end[wall]});
      highest[chunk] = std::max({highest[chunk], walls.start[wall], walls.end[wall]});
    }
  }
  walls.end_joint.assign(count, joint_count);
  for (int chunk = count - 1; chunk > 0; --chunk) {
    walls.end_joint[chunk - 1] = std::min(walls.end_joint[chunk], lowest[chunk]);
  }
  walls.first_joint.assign(count, 0);
  for (int chunk = 1; chunk < count; ++chunk) {
    walls.first_joint[chunk] =
        std::max({walls.first_joint[chunk - 1], highest[chunk - 1] + 1, walls.end_joint[chunk - 1]});
  }
}

/// Sorts items into lists by node: fills `items` list by list, in the order of the visits, and `offset` into it.
/// visit_all(visit) calls visit(node, item) for each.
template <class VisitAll>
void list_by_node(std::size_t nodes, const VisitAll& visit_all, std::vector<int>& offset, std::vector<int>& items) {
  offset.assign(nodes + 1, 0);
  visit_all([&](int node, int) { ++offset[node + 1]; });
  std::partial_sum(offset.begin(), offset.end(), offset.begin());
  items.resize(static_cast<std::size_t>(offset.back()));
  std::vector<int> next(offset.begin(), offset.end() - 1);
  visit_all([&](int node, int item) { items[next[node]++] = item; });
}

}  // namespace

void divide_walls(const Layout& layout, Scene& scene) {
  const std::size_t elements = layout.element_count();
  scene.elements.reserve(elements);
  scene.position.reserve(layout.joints.size() + elements - layout.walls.size());
  scene.position.assign(layout.joints.begin(), layout.joints.end());
  scene.joint_count = static_cast<int>(layout.joints.size());
  const auto rigid = std::ranges::find(layout.walls, true, &LayoutWall::rigid);
  for (auto first = layout.walls.begin(); first != rigid;) {
    const auto most = first + std::min<std::ptrdiff_t>(kMostWallsInBlock, rigid - first);
    const auto end =
        std::find_if(first, most, [&](const LayoutWall& wall) { return wall.elements != first->elements; });
    const WallBlock block = {static_cast<int>(first - layout.walls.begin()), static_cast<int>(end - first),
                             first->elements, static_cast<int>(scene.elements.size()),
                             static_cast<int>(scene.position.size())};
    divide_block(layout, block, scene);
    scene.walls.blocks.push_back(block);
    first = end;
  }
  scene.walls.chunk_offset = chunk_offsets(scene.walls.blocks);
  for (auto wall = layout.walls.begin(); wall != rigid; ++wall) {
    scene.walls.start.push_back(wall->start);
    scene.walls.end.push_back(wall->end);
    scene.walls.thickness.push_back(wall->thickness);
    scene.walls.undeformed_length.push_back(length_of(layout, *wall) / wall->elements);
    scene.walls.material.push_back(wall->material);
  }
  order_joints(scene.walls, scene.joint_count);
  scene.rigid.first_element = static_cast<int>(scene.elements.size());
  for (auto wall = rigid; wall != layout.walls.end(); ++wall) {
    scene.elements.push_back({wall->start, wall->end, wall->thickness, wall->material});
  }
}

void link_elements(Scene& scene) {
  const auto visit_elements = [&](const auto& visit) {
    for (std::size_t e = 0; e < scene.element_count(); ++e) {
      visit(scene.elements[e].start, static_cast<int>(e));
      visit(scene.elements[e].end, static_cast<int>(e));
    }
  };
  // For each block, first the starts of its walls, then the ends.
  const auto visit_wall_ends = [&](const auto& visit) {
    int index = 0;  // into State::wall_force
    for (const WallBlock& block : scene.walls.blocks) {
      for (const std::vector<int>* joints : {&scene.walls.start, &scene.walls.end}) {
        for (int wall = block.first_wall; wall < block.first_wall + block.walls; ++wall) {
          visit((*joints)[wall], index++);
        }
      }
    }
  };
  list_by_node(scene.particle_count(), visit_elements, scene.incidence_offset, scene.incidence);
  list_by_node(scene.joint_count, visit_wall_ends, scene.wall_end_offset, scene.wall_ends);
}

}  // namespace cellcrush

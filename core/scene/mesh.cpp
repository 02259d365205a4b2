#include "scene/mesh.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "scene/frame.h"

namespace cellcrush {
namespace {

/// Along the chord and to its left: position at a share of a circular arc that rises over its chord.
Vector2 place_on_arc(double chord, double rise, double share) {
  const double half_angle = 2.0 * std::atan(2.0 * rise / chord);
  const double radius = 0.5 * chord / std::sin(half_angle);
  const double angle = (2.0 * share - 1.0) * half_angle;
  return {0.5 * chord + radius * std::sin(angle), radius * (std::cos(angle) - std::cos(half_angle))};
}

/// Length of a wall along its elements.
double length_of(const Layout& layout, const LayoutWall& wall) {
  if (wall.bow == 0.0 && wall.rise == 0.0) {
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

/// 1 for each particle without a rotation of its own: the common nodes of pairs of elements (E5b).
std::vector<char> nodes_without_rotation(const Scene& scene) {
  std::vector<char> without(scene.particle_count(), 0);
  for (const WallBlock& block : scene.walls.blocks) {
    if (!scene.section.force_based || !block.has_pairs()) {
      continue;
    }
    for (int j = 0; j < block.elements; j += 2) {
      std::fill_n(without.begin() + block.first_inner + j * block.walls, block.walls, 1);
    }
  }
  return without;
}

/// Mass and rotary inertia that an element gives to either end.
EndShare lump_element(const Scene& scene, const Element& element) {
  const double length = (scene.position[element.end] - scene.position[element.start]).norm();
  const double half_mass = 0.5 * scene.materials[element.material].density * scene.depth * element.thickness * length;
  const double lumped = scene.mass_scaling.mass * half_mass;
  const double gyration_squared = element.thickness * element.thickness / 12.0;
  return {lumped, scene.mass_scaling.rotary * lumped * gyration_squared};
}

double inverse_of(double value) { return value > 0.0 ? 1.0 / value : 0.0; }

}  // namespace

Vector2 place_on(const Layout& layout, const LayoutWall& wall, double share) {
  const Vector2& from = layout.joints[wall.start];
  const Vector2 along = layout.joints[wall.end] - from;
  const Vector2 straight = from + along * share;
  if (wall.bow == 0.0 && wall.rise == 0.0) {
    return straight;
  }
  const Vector2 forward = along.normalized();
  const Vector2 to_the_left(-forward.y(), forward.x());
  const Vector2 bowed = wall.bow * std::sin(std::numbers::pi * share) * to_the_left;
  if (wall.rise == 0.0) return straight + bowed;
  const Vector2 on_arc = place_on_arc(along.norm(), wall.rise, share);
  return from + on_arc.x() * forward + on_arc.y() * to_the_left + bowed;
}

double rise_between(const Layout& layout, const LayoutWall& wall, double from, double to) {
  if (wall.bow == 0.0 && wall.rise == 0.0) return 0.0;
  const Vector2 start = place_on(layout, wall, from);
  const Vector2 end = place_on(layout, wall, to);
  const Vector2 middle = place_on(layout, wall, 0.5 * (from + to));
  return cross((end - start).normalized(), middle - start);
}

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

void let_walls_shear(const std::vector<MaterialSpec>& materials, Scene& scene) {
  Walls& walls = scene.walls;
  if (scene.section.shear_factor == 0.0) return;
  for (std::size_t w = 0; w < walls.thickness.size(); ++w) {
    const MaterialSpec& material = materials[walls.material[w]];
    const double nu = material.poissons_ratio;
    const bool held = material.plane == MaterialSpec::Plane::strain;
    const double modulus = held ? 2.0 / (1.0 - nu) : 2.0 * (1.0 + nu);  // of bending, over that of shear
    const double slenderness = walls.thickness[w] / walls.undeformed_length[w];
    walls.shear.push_back(modulus / scene.section.shear_factor * slenderness * slenderness / 12.0);
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

void lump_masses(Scene& scene) {
  scene.mass.resize(scene.particle_count(), 0.0);
  scene.inertia.resize(scene.particle_count(), 0.0);
  scene.radius.assign(scene.particle_count(), 0.0);
  const std::vector<char> without_rotation = nodes_without_rotation(scene);
  for (const Element& element : scene.elements) {
    const auto [lumped, half_inertia] = lump_element(scene, element);
    for (const auto& [node, other] : {std::pair(element.start, element.end), std::pair(element.end, element.start)}) {
      scene.mass[node] += lumped;
      scene.inertia[without_rotation[node] != 0 ? other : node] += half_inertia;
      scene.radius[node] = std::max(scene.radius[node], 0.5 * element.thickness);
      scene.largest_radius = std::max(scene.largest_radius, scene.radius[node]);
    }
    scene.total_mass += 2.0 * (lumped / scene.mass_scaling.mass);
  }
  share_pin_masses(scene);
  scene.smallest_radius = std::ranges::min(scene.radius);
  scene.inverse_mass.reserve(scene.particle_count());
  scene.inverse_inertia.reserve(scene.particle_count());
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    scene.inverse_mass.push_back(1.0 / scene.mass[i]);
    scene.inverse_inertia.push_back(inverse_of(scene.inertia[i]));
  }
}

EndShare share_of_end(const Scene& scene, int wall, const WallBlock& block, bool at_end) {
  const int row = at_end ? block.elements - 1 : 0;
  const int element = block.first_element + row * block.walls + wall - block.first_wall;
  EndShare share = lump_element(scene, scene.elements[element]);
  if (scene.section.force_based && block.has_pairs()) share.inertia += share.inertia;  // that of the middle too
  return share;
}

void lump_rigid_bodies(Scene& scene) {
  RigidBodies& rigid = scene.rigid;
  rigid.centre.clear();
  rigid.mass.clear();
  rigid.inertia.clear();
  for (std::size_t body = 0; body + 1 < rigid.offset.size(); ++body) {
    double mass = 0.0;
    Vector2 moment = Vector2::Zero();
    for (int i = rigid.offset[body]; i < rigid.offset[body + 1]; ++i) {
      mass += scene.mass[i];
      moment += scene.mass[i] * scene.position[i];
    }
    const Vector2 centre = moment / mass;
    double inertia = 0.0;
    for (int i = rigid.offset[body]; i < rigid.offset[body + 1]; ++i) {
      inertia += scene.inertia[i] + scene.mass[i] * (scene.position[i] - centre).squaredNorm();
    }
    rigid.centre.push_back(centre);
    rigid.mass.push_back(mass);
    rigid.inertia.push_back(inertia);
  }
}

}  // namespace cellcrush

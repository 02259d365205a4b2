#include "scene/masses.h"

#include <algorithm>

namespace cellcrush {

void lump_masses(Scene& scene) {
  scene.mass.resize(scene.particle_count(), 0.0);
  scene.inertia.resize(scene.particle_count(), 0.0);
  scene.radius.assign(scene.particle_count(), 0.0);
  for (const Element& element : scene.elements) {
    const double length = (scene.position[element.end] - scene.position[element.start]).norm();
    const double half_mass = 0.5 * scene.materials[element.material].density * scene.depth * element.thickness * length;
    const double gyration_squared = element.thickness * element.thickness / 12.0;
    const double lumped = scene.mass_scaling.mass * half_mass;
    for (const int node : {element.start, element.end}) {
      scene.mass[node] += lumped;
      scene.inertia[node] += scene.mass_scaling.rotary * lumped * gyration_squared;
      scene.radius[node] = std::max(scene.radius[node], 0.5 * element.thickness);
      scene.largest_radius = std::max(scene.largest_radius, scene.radius[node]);
    }
    scene.total_mass += 2.0 * half_mass;
  }
  scene.smallest_radius = *std::min_element(scene.radius.begin(), scene.radius.end());
  scene.inverse_mass.reserve(scene.particle_count());
  scene.inverse_inertia.reserve(scene.particle_count());
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    scene.inverse_mass.push_back(1.0 / scene.mass[i]);
    scene.inverse_inertia.push_back(1.0 / scene.inertia[i]);
  }
}

namespace {

/// Calls visit(joint, index into State::wall_force) for every end of a wall: for each block, first the starts of its
/// walls, then the ends.
template <class Visit>
void visit_wall_ends(const Scene& scene, Visit&& visit) {
  for (const WallBlock& block : scene.walls.blocks) {
    for (const std::vector<int>* joints : {&scene.walls.start, &scene.walls.end}) {
      const int first = 2 * block.first_wall + (joints == &scene.walls.start ? 0 : block.walls);
      for (int w = 0; w < block.walls; ++w) {
        visit((*joints)[block.first_wall + w], first + w);
      }
    }
  }
}

void link_wall_ends(Scene& scene) {
  scene.wall_end_offset.assign(static_cast<std::size_t>(scene.joint_count) + 1, 0);
  visit_wall_ends(scene, [&](int joint, int) { ++scene.wall_end_offset[joint + 1]; });
  for (int joint = 0; joint < scene.joint_count; ++joint) {
    scene.wall_end_offset[joint + 1] += scene.wall_end_offset[joint];
  }
  scene.wall_ends.resize(2 * scene.walls.start.size());
  std::vector<int> next(scene.wall_end_offset.begin(), scene.wall_end_offset.end() - 1);
  visit_wall_ends(scene, [&](int joint, int end) { scene.wall_ends[next[joint]++] = end; });
}

}  // namespace

void link_elements(Scene& scene) {
  scene.incidence_offset.assign(scene.particle_count() + 1, 0);
  for (const Element& element : scene.elements) {
    ++scene.incidence_offset[element.start + 1];
    ++scene.incidence_offset[element.end + 1];
  }
  for (std::size_t node = 0; node < scene.particle_count(); ++node) {
    scene.incidence_offset[node + 1] += scene.incidence_offset[node];
  }
  scene.incidence.resize(2 * scene.element_count());
  std::vector<int> next(scene.incidence_offset.begin(), scene.incidence_offset.end() - 1);
  for (std::size_t e = 0; e < scene.element_count(); ++e) {
    scene.incidence[next[scene.elements[e].start]++] = static_cast<int>(e);
    scene.incidence[next[scene.elements[e].end]++] = static_cast<int>(e);
  }
  link_wall_ends(scene);
}

}  // namespace cellcrush

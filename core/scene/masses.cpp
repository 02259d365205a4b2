#include "scene/masses.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "scene/pins.h"

namespace cellcrush {

namespace {

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

double inverse_of(double value) { return value > 0.0 ? 1.0 / value : 0.0; }

}  // namespace

void lump_masses(Scene& scene) {
  scene.mass.resize(scene.particle_count(), 0.0);
  scene.inertia.resize(scene.particle_count(), 0.0);
  scene.radius.assign(scene.particle_count(), 0.0);
  const std::vector<char> without_rotation = nodes_without_rotation(scene);
  for (const Element& element : scene.elements) {
    const double length = (scene.position[element.end] - scene.position[element.start]).norm();
    const double half_mass = 0.5 * scene.materials[element.material].density * scene.depth * element.thickness * length;
    const double gyration_squared = element.thickness * element.thickness / 12.0;
    const double lumped = scene.mass_scaling.mass * half_mass;
    const double half_inertia = scene.mass_scaling.rotary * lumped * gyration_squared;
    for (const auto& [node, other] : {std::pair(element.start, element.end), std::pair(element.end, element.start)}) {
      scene.mass[node] += lumped;
      scene.inertia[without_rotation[node] != 0 ? other : node] += half_inertia;
      scene.radius[node] = std::max(scene.radius[node], 0.5 * element.thickness);
      scene.largest_radius = std::max(scene.largest_radius, scene.radius[node]);
    }
    scene.total_mass += 2.0 * half_mass;
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

void lump_rigid_bodies(Scene& scene) {
  RigidBodies& rigid = scene.rigid;
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

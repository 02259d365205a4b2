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
  scene.smallest_radius = std::ranges::min(scene.radius);
  scene.inverse_mass.reserve(scene.particle_count());
  scene.inverse_inertia.reserve(scene.particle_count());
  for (std::size_t i = 0; i < scene.particle_count(); ++i) {
    scene.inverse_mass.push_back(1.0 / scene.mass[i]);
    scene.inverse_inertia.push_back(1.0 / scene.inertia[i]);
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

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
    }
    scene.total_mass += 2.0 * half_mass;
  }
}

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
}

}  // namespace cellcrush

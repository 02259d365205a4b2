#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "measure/theory.h"
#include "step/what_is_modelled.h"

namespace cellcrush {

SceneFacts facts_of(const Scene& scene) {
  SceneFacts facts;
  facts.particle_count = static_cast<std::int64_t>(scene.particle_count());
  facts.element_count = static_cast<std::int64_t>(scene.element_count());
  facts.mass = scene.total_mass;
  facts.relative_density = relative_density_of(scene);
  facts.length = scene.length;
  facts.width = scene.width;
  facts.stable_step = scene.stable_step;
  facts.time_step = scene.schedule.time_step;
  facts.step_count = scene.schedule.step_count;
  facts.sample_interval = scene.schedule.sample_interval;
  facts.frame_interval = scene.schedule.frame_interval;
  facts.theory = theory_of(scene);
  facts.modelled = what_is_modelled(scene);
  return facts;
}

MeshView mesh_of(const Scene& scene) {
  MeshView mesh;
  for (const Element& element : scene.elements) {
    mesh.element_nodes.push_back(element.start);
    mesh.element_nodes.push_back(element.end);
    mesh.thickness.push_back(static_cast<float>(element.thickness));
  }
  mesh.length = scene.length;
  mesh.width = scene.width;
  mesh.impact_plate = scene.plates.impact_face;
  mesh.support_plate = scene.plates.support_face;
  mesh.along_y = scene.plates.axis == 1;
  return mesh;
}

}  // namespace cellcrush

#include "cellcrush/scene.h"
#include "cellcrush/simulation.h"
#include "cellcrush/state.h"
#include "contact/candidate_lists.h"
#include "contact/contact_workspace.h"
#include "measure/theory.h"
#include "step/what_is_modelled.h"

namespace cellcrush {
namespace {

/// Bytes of a run: the state's and the scene's arrays. Contact candidates are counted at kCandidatesPerParticle, pairs that
/// touch one a particle: what a densified lattice has.
std::int64_t memory_of(const Scene& scene) {
  constexpr std::size_t kCandidatesPerParticle = 6;
  // What is remembered of it in two steps, how it stands, and what pushes.
  constexpr std::size_t kBytesPerTouch = 2 * (5 * sizeof(int) + sizeof(double)) + 2 * sizeof(int) + 5 * sizeof(double) +
                                         2 * sizeof(Vector2) + sizeof(Push);
  const std::size_t per_particle = 9 * sizeof(Vector2) + 9 * sizeof(double) + 2 * sizeof(int) +
                                   kCandidatesPerParticle * (sizeof(Candidate) + sizeof(double)) + kBytesPerTouch;
  const std::size_t per_element = sizeof(Element) + 2 * sizeof(int) + sizeof(Vector2) + sizeof(double) +
                                  3 * (sizeof(Vector2) + sizeof(double)) / 2 + sizeof(std::uint64_t) +
                                  ((scene.has_hardening() ? 3 : 1) * scene.fibre_count() +
                                   (scene.section.force_based ? 2 * scene.section.section_count() + 2 : 0)) *
                                      sizeof(double);
  const std::size_t per_corner = 2 * sizeof(int) + sizeof(Vector2);
  return static_cast<std::int64_t>(scene.particle_count() * per_particle + scene.element_count() * per_element +
                                   scene.faces.particle.size() * per_corner);
}

}  // namespace

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
  facts.memory_bytes = memory_of(scene);
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

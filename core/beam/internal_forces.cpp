#include "beam/internal_forces.h"

#include <algorithm>

#include "beam/beam_element.h"
#include "beam/deformation.h"
#include "beam/element_place.h"
#include "beam/joint_forces.h"
#include "beam/wide_walls.h"
#include "simd/target.h"

namespace cellcrush {
namespace {

/// Adds an element's forces to the particles inside its wall, or notes them for the joints.
void put_forces(const Scene& scene, State& state, const ElementPlace& place, int wall, const ElementForces& forces) {
  const Element& element = scene.elements[place.element];
  const auto lane = static_cast<int>(place.element - place.row);
  const std::size_t at_start = 2 * static_cast<std::size_t>(wall) - static_cast<std::size_t>(lane);
  if (element.start < scene.joint_count) {
    state.wall_force[at_start] = forces.force_on_end;
    state.wall_moment[at_start] = -forces.moment_on_start;
  } else {
    state.internal_force[element.start] += forces.force_on_end;
    state.internal_moment[element.start] -= forces.moment_on_start;
  }
  if (element.end < scene.joint_count) {
    state.wall_force[at_start + place.stride] = -forces.force_on_end;
    state.wall_moment[at_start + place.stride] = -forces.moment_on_end;
  } else {
    state.internal_force[element.end] = -forces.force_on_end;
    state.internal_moment[element.end] = -forces.moment_on_end;
  }
}

/// Fixed numbers of points compile to straight code; 0 takes the rule's.
template <int kDepthPoints, bool kHardening, class T>
void evaluate_elements(const Scene& scene, State& state, FibreMemory<T>& memory) {
  const double step = state.step == 0 ? 0.0 : scene.schedule.time_step;
  const bool force_based = scene.section.force_based;
  double plastic_work = 0.0;
  visit_elements(scene, [&](const ElementPlace& place, int wall) {
    const std::size_t e = place.element;
    const Element& element = scene.elements[e];
    const double previous_length = state.length[e];
    const Deformation deformation =
        reverse_motion(state.position[element.end] - state.position[element.start], state.axis[e], previous_length,
                       step * state.spin[element.start], step * state.spin[element.end]);
    const BeamSection section = section_of(scene, wall, deformation.length);
    Material material = scene.materials[element.material];
    material.youngs_modulus *= section.stiffness;
    const std::size_t fibre = place.index(scene.fibre_count(), 0);
    const Fibres<T> fibres = {&memory.stress[fibre], kHardening ? &memory.back_stress[fibre] : nullptr,
                              kHardening ? &memory.plastic_strain[fibre] : nullptr,
                              kHardening ? nullptr : &memory.flowed[e], place.stride};
    const std::size_t remembered = force_based ? place.index(scene.section.section_count(), 0) : 0;
    const SectionMemory<T> sections = {memory.section_unbalance.data() + remembered,
                                       memory.section_flexibility.data() + remembered, place.stride};
    EndMoments moments;
    if (force_based) {
      moments = {memory.start_moment[e], memory.end_moment[e]};
    }
    const ElementForces forces = evaluate_element<kDepthPoints, kHardening>(
        deformation, previous_length, material, section, scene.section, fibres, sections, moments, plastic_work);
    state.axis[e] = deformation.axis;
    state.length[e] = deformation.length;
    state.inverse_length[e] = 1.0 / deformation.length;
    if (force_based) {
      memory.start_moment[e] = static_cast<T>(moments.start);
      memory.end_moment[e] = static_cast<T>(moments.end);
    }
    put_forces(scene, state, place, wall, forces);
  });
  state.ledger.plastic += plastic_work;
}

template <bool kHardening, class T>
void evaluate_rule(const Scene& scene, State& state, FibreMemory<T>& memory) {
  switch (scene.section.depth_count()) {
    case 4: evaluate_elements<4, kHardening>(scene, state, memory); break;
    case 6: evaluate_elements<6, kHardening>(scene, state, memory); break;
    default: evaluate_elements<0, kHardening>(scene, state, memory); break;
  }
}

template <class T>
void evaluate_walls(const Scene& scene, State& state, FibreMemory<T>& memory) {
  if (scene.has_hardening()) {
    evaluate_rule<true>(scene, state, memory);
  } else {
    evaluate_rule<false>(scene, state, memory);
  }
}

}  // namespace

void evaluate_internal_forces(const Scene& scene, State& state, WallsWorkspace& workspace, Workers& workers,
                              const std::function<void()>& meanwhile) {
  if (use_wide_kernels() && has_vector_kernel(scene.section)) {
    evaluate_walls_wide(scene, state, workspace, workers, meanwhile);
    return;
  }
  scene.single_fibres ? evaluate_walls(scene, state, state.single_fibres) : evaluate_walls(scene, state, state.fibres);
  sum_joint_forces(scene, state, 0, static_cast<std::size_t>(scene.joint_count));
  meanwhile();
}

}  // namespace cellcrush

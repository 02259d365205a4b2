#include "beam/internal_forces.h"

#include <algorithm>

#include "beam/beam_element.h"
#include "beam/deformation.h"

namespace cellcrush {
namespace {

/// Fixed numbers of points compile to straight code; 0 takes the rule's.
template <int kDepthPoints, bool kHardening>
void evaluate_elements(const Scene& scene, State& state) {
  const double step = state.step == 0 ? 0.0 : scene.schedule.time_step;
  double plastic_work = 0.0;
  const std::size_t remembered = scene.section.force_based ? scene.section.section_count() : 0;
  for (std::size_t e = 0; e < scene.element_count(); ++e) {
    const Element& element = scene.elements[e];
    const double previous_length = state.length[e];
    const Deformation deformation =
        reverse_motion(state.position[element.end] - state.position[element.start], state.axis[e], previous_length,
                       step * state.spin[element.start], step * state.spin[element.end]);
    const BeamSection section = section_of(scene, e, deformation.length);
    Material material = scene.materials[element.material];
    material.youngs_modulus *= section.stiffness;
    const std::size_t first = e * scene.fibre_count();
    const Fibres fibres = {&state.stress[first], &state.back_stress[first], &state.plastic_strain[first]};
    const SectionMemory memory = {state.section_unbalance.data() + e * remembered,
                                  state.section_tangent.data() + e * remembered};
    state.internal[e] =
        evaluate_element<kDepthPoints, kHardening>(deformation, previous_length, material, section, scene.section,
                                                   fibres, memory, state.internal[e], plastic_work);
    state.axis[e] = deformation.axis;
    state.length[e] = deformation.length;
  }
  state.ledger.plastic += plastic_work;
}

template <bool kHardening>
void evaluate_all(const Scene& scene, State& state) {
  switch (scene.section.depth_count()) {
    case 4: evaluate_elements<4, kHardening>(scene, state); break;
    case 6: evaluate_elements<6, kHardening>(scene, state); break;
    default: evaluate_elements<0, kHardening>(scene, state); break;
  }
}

}  // namespace

void evaluate_internal_forces(const Scene& scene, State& state) {
  if (std::any_of(scene.materials.begin(), scene.materials.end(),
                  [](const Material& material) { return material.hardening_modulus > 0.0; })) {
    evaluate_all<true>(scene, state);
  } else {
    evaluate_all<false>(scene, state);
  }
}

}  // namespace cellcrush

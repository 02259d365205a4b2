#include "beam/internal_forces.h"

#include "beam/beam_element.h"
#include "beam/deformation.h"

namespace cellcrush {

void evaluate_internal_forces(const Scene& scene, State& state) {
  const double step = state.step == 0 ? 0.0 : scene.schedule.time_step;
  double plastic_work = 0.0;
  for (std::size_t e = 0; e < scene.element_count(); ++e) {
    const Element& element = scene.elements[e];
    const double previous_length = state.length[e];
    const Deformation deformation =
        reverse_motion(state.position[element.end] - state.position[element.start], state.axis[e], previous_length,
                       step * state.spin[element.start], step * state.spin[element.end]);
    const BeamSection section = {element.thickness, scene.depth * element.thickness};
    const std::size_t first = e * scene.fibre_count();
    const Fibres fibres = {&state.stress[first], &state.back_stress[first], &state.plastic_strain[first]};
    state.internal[e] = evaluate_element(deformation, previous_length, scene.materials[element.material], section,
                                         scene.section, fibres, plastic_work);
    state.axis[e] = deformation.axis;
    state.length[e] = deformation.length;
  }
  state.ledger.plastic += plastic_work;
}

}  // namespace cellcrush

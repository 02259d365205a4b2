#include "measure/theory.h"

namespace cellcrush {

double relative_density_of(const Scene& scene) {
  const double envelope = scene.length * scene.width * scene.depth;
  return envelope > 0.0 ? scene.total_mass / (scene.materials.front().density * envelope) : 0.0;
}

Theory theory_of(const Scene& scene) {
  if (!scene.plates.present) {
    return {};
  }
  Theory theory;
  const double relative_density = relative_density_of(scene);
  theory.gibson_ashby = scene.collapse_stress;
  theory.densification_strain = 1.0 - 1.4 * relative_density;
  const double density = scene.materials.front().density * relative_density;
  theory.shock = theory.gibson_ashby + density * scene.plates.speed * scene.plates.speed / theory.densification_strain;
  return theory;
}

}  // namespace cellcrush

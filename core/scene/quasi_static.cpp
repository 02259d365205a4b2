#include "scene/quasi_static.h"

#include <algorithm>
#include <cmath>

#include "cellcrush/sample.h"

namespace cellcrush {

double quasi_static_speed(double share, double relative_density, const Material& material) {
  const double of_walls = material.yield_stress / material.density;
  return std::sqrt(3.0 * Summary::kPlateauLow * share * relative_density * of_walls);
}

SceneSpec with_chosen_speed(SceneSpec spec, const MeshMeasures& mesh) {
  if (spec.loading.quasi_static) {
    const double speed = quasi_static_speed(spec.loading.kinetic_share, mesh.relative_density, mesh.material);
    spec.loading.speed_m_per_s = speed / kMmPerM;
  }
  return spec;
}

double slowing_of_quasi_static(double end_strain) {
  constexpr double kSlower = 2.4;  // the start, and cells that snap
  return kSlower * (end_strain + std::min(Summary::kPlateauLow, end_strain)) / end_strain;
}

}  // namespace cellcrush

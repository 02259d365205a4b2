#include "measure/theory.h"

#include <numbers>

namespace cellcrush {

double collapse_stress_of(const HexagonLattice& lattice, double yield_stress, LoadingSpec::Direction /*direction*/) {
  const double slenderness = *lattice.wall_thickness_mm / *lattice.side_mm;
  return 2.0 / 3.0 * yield_stress * slenderness * slenderness;
}

double collapse_stress_of(const SquareLattice& lattice, double yield_stress, LoadingSpec::Direction /*direction*/) {
  return yield_stress * *lattice.wall_thickness_mm / *lattice.side_mm;
}

double collapse_stress_of(const TriangleLattice& lattice, double yield_stress, LoadingSpec::Direction direction) {
  const double factor = direction == LoadingSpec::Direction::x ? 2.0 / std::numbers::sqrt3 : std::numbers::sqrt3;
  return factor * yield_stress * *lattice.wall_thickness_mm / *lattice.side_mm;
}

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

#include "scene/collapse_stress.h"

#include <numbers>

namespace cellcrush {

double collapse_stress_of(const SceneSpec& spec) {
  const double yield_stress = *spec.material.yield_stress_mpa;
  if (const auto* hexagon = std::get_if<HexagonLattice>(&spec.lattice)) {
    const double slenderness = *hexagon->wall_thickness_mm / *hexagon->side_mm;
    return 2.0 / 3.0 * yield_stress * slenderness * slenderness;
  }
  if (const auto* square = std::get_if<SquareLattice>(&spec.lattice)) {
    return yield_stress * *square->wall_thickness_mm / *square->side_mm;
  }
  const auto& triangle = std::get<TriangleLattice>(spec.lattice);
  const bool is_along_walls = spec.loading.direction == LoadingSpec::Direction::x;
  const double factor = is_along_walls ? 2.0 / std::numbers::sqrt3 : std::numbers::sqrt3;
  return factor * yield_stress * *triangle.wall_thickness_mm / *triangle.side_mm;
}

}  // namespace cellcrush

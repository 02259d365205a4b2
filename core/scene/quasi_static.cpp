#include "scene/quasi_static.h"

#include <cmath>

#include "cellcrush/sample.h"

namespace cellcrush {

double quasi_static_speed(double share, double relative_density, const Material& material) {
  const double of_walls = material.yield_stress / material.density;
  return std::sqrt(3.0 * Summary::kPlateauLow * share * relative_density * of_walls);
}

}  // namespace cellcrush

#include "scene/stable_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cellcrush {

double stable_step_of_element(double length, double thickness, const Material& material) {
  const double wave_speed = std::sqrt(material.youngs_modulus / material.density);
  const double gyration_squared = thickness * thickness / 12.0;
  return length / wave_speed / std::numbers::sqrt3 / std::sqrt(1.0 + 4.0 * gyration_squared / (length * length));
}

double stable_step_of(const Scene& scene) {
  double least = std::numeric_limits<double>::infinity();
  for (const Element& element : scene.elements) {
    const double length = (scene.position[element.end] - scene.position[element.start]).norm();
    least = std::min(least, stable_step_of_element(length, element.thickness, scene.materials[element.material]));
  }
  return least;
}

}  // namespace cellcrush

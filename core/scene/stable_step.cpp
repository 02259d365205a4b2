#include "scene/stable_step.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cellcrush {

double stable_step_of_element(double length, double thickness, const Material& material, const MassScaling& scaling) {
  const double wave_speed = std::sqrt(material.youngs_modulus / material.density);
  const double gyration_squared = thickness * thickness / 12.0;
  const double rotary = scaling.rotary;
  const double turning = std::sqrt(rotary / 3.0) / std::sqrt(1.0 + 4.0 * rotary * gyration_squared / (length * length));
  return std::sqrt(scaling.mass) * length / wave_speed * std::min(1.0, turning);
}

double stable_step_of(const Scene& scene) {
  double least = std::numeric_limits<double>::infinity();
  for (const Element& element : scene.elements) {
    const double length = (scene.position[element.end] - scene.position[element.start]).norm();
    least = std::min(least, stable_step_of_element(length, element.thickness, scene.materials[element.material],
                                                   scene.mass_scaling));
  }
  return least;
}

}  // namespace cellcrush

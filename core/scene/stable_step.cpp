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
  const Walls& walls = scene.walls;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t w = 0; w < walls.start.size(); ++w) {
    least = std::min(least, stable_step_of_element(walls.undeformed_length[w], walls.thickness[w],
                                                   scene.materials[walls.material[w]], scene.mass_scaling));
  }
  return least;
}

}  // namespace cellcrush

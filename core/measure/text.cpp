#include "measure/text.h"

#include <cmath>

#include "scene/check_spec.h"

namespace cellcrush {

std::string moment_of(std::int64_t step, double time) {
  return "step " + std::to_string(step) + ", t = " + to_text(time) + " s";
}

std::string place_of(const Scene& scene, std::size_t particle) {
  return "particle " + std::to_string(particle) + ", at (" + to_text(scene.position[particle].x()) + ", " +
         to_text(scene.position[particle].y()) + ") mm before loading";
}

std::string percent_of(double share) { return to_text(std::round(1000.0 * share) / 10.0) + " %"; }

}  // namespace cellcrush

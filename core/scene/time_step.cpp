#include "scene/time_step.h"

#include <algorithm>

#include "scene/contact_law.h"

namespace cellcrush {
namespace {

constexpr double kTravelPerStep = 0.05;  // of the thinnest wall, by the plate

}  // namespace

double time_step_of(const SceneSpec& spec, const Scene& scene) {
  if (spec.numerics.time_step_s > 0.0) {
    return spec.numerics.time_step_s;
  }
  double step = kStepFraction * scene.stable_step;
  if (scene.plates.present) {
    step = std::min(step, kTravelPerStep * thinnest_wall(scene) / scene.plates.speed);
  }
  if (scene.contact.present) {
    const double lightest = *std::min_element(scene.mass.begin(), scene.mass.end());
    step = std::min(step, kStepFraction * contact_step_of(scene.contact, lightest));
  }
  return step;
}

}  // namespace cellcrush

#include "scene/time_step.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "scene/contact_law.h"

namespace cellcrush {
namespace {

constexpr double kTravelPerStep = 0.05;  // of the thinnest wall, by the plate
constexpr double kTurnOfStacks = 0.11;   // rad, of the lightest particle on its contact

/// Whether walls lie along the crush and are stacked in it.
bool stacks(const SceneSpec& spec) {
  return std::holds_alternative<SquareLattice>(spec.lattice) || std::holds_alternative<TriangleLattice>(spec.lattice);
}

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
    if (stacks(spec)) {
      step = std::min(step, kTurnOfStacks * std::sqrt(lightest / scene.contact.stiffness));
    }
  }
  return step;
}

}  // namespace cellcrush

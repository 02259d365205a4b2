#include "scene/time_step.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "scene/contact_law.h"

namespace cellcrush {
namespace {

constexpr double kTravelPerStep = 0.05;  // of the thinnest wall, by the plate

/// Whether walls lie along the crush and are stacked in it.
bool stacks(const SceneSpec& spec) {
  return std::holds_alternative<SquareLattice>(spec.lattice) || std::holds_alternative<TriangleLattice>(spec.lattice);
}

/// Greatest turn in a step of the lightest particle on its contact, rad: less where the crush is slow against
/// sqrt(sigma_y / rho), and its work therefore small.
double turn_of_stacks(const Scene& scene) {
  constexpr double kTurn = 0.11;
  constexpr double kFast = 0.45;  // speed over sqrt(sigma_y / rho)
  constexpr double kLeastShare = 1.0 / 3.0;
  const Material& material = scene.materials.front();
  const double speed = scene.plates.speed / std::sqrt(material.yield_stress / material.density);
  return kTurn * std::clamp(speed / kFast, kLeastShare, 1.0);
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
      step = std::min(step, turn_of_stacks(scene) * std::sqrt(lightest / scene.contact.stiffness));
    }
  }
  return step;
}

}  // namespace cellcrush

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

TimeStep time_step_of(const SceneSpec& spec, const Scene& scene) {
  if (spec.numerics.time_step_s > 0.0) {
    return {spec.numerics.time_step_s, StepBound::asked_for};
  }
  TimeStep step = {kStepFraction * scene.stable_step, StepBound::elements};
  const auto hold_to = [&step](double seconds, StepBound bound) {
    if (seconds < step.seconds) {
      step = {seconds, bound};
    }
  };
  if (scene.plates.present) {
    hold_to(kTravelPerStep * thinnest_wall(scene) / scene.plates.speed, StepBound::plate_travel);
  }
  if (scene.contact.present) {
    const double lightest = *std::min_element(scene.mass.begin(), scene.mass.end());
    hold_to(kStepFraction * contact_step_of(scene.contact, lightest), StepBound::contacts);
    if (stacks(spec)) {
      hold_to(turn_of_stacks(scene) * std::sqrt(lightest / scene.contact.stiffness), StepBound::stacked_walls);
    }
  }
  return step;
}

}  // namespace cellcrush

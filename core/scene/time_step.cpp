#include "scene/time_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "lattice/lattice.h"
#include "scene/contact_law.h"
#include "scene/mesh_part.h"

namespace cellcrush {
namespace {

/// Greatest phase angle omega dt of the lightest particle on its contact, rad. Contacts make more energy, against the
/// work of the plate, in slow crushes and on coarse meshes: there the angle is less.
double phase_of_stacks(const Material& material, double plate_speed, int elements_per_wall) {
  constexpr double kPhase = 0.3;
  constexpr double kFast = 1.44;  // speed over sqrt(sigma_y / rho), times the elements per wall
  constexpr double kLeastShare = 1.0 / 8.0;
  const double speed = plate_speed / std::sqrt(material.yield_stress / material.density);
  return kPhase * std::clamp(elements_per_wall * speed / kFast, kLeastShare, 1.0);
}

}  // namespace

double stable_step_of_element(double length, double thickness, const Material& material, const MassScaling& scaling) {
  const double wave_speed = std::sqrt(material.youngs_modulus / material.density);
  const double gyration_squared = thickness * thickness / 12.0;
  const double rotary = scaling.rotary;
  const double turning = std::sqrt(rotary / 3.0) / std::sqrt(1.0 + 4.0 * rotary * gyration_squared / (length * length));
  return std::sqrt(scaling.mass) * length / wave_speed * std::min(1.0, turning);
}

double stable_step_of_pair(double length, double thickness, const Material& material, const MassScaling& scaling) {
  const double wave_speed = std::sqrt(material.youngs_modulus / material.density);
  const double slender = thickness * thickness / (12.0 * length * length);
  const double a = 4.0 / scaling.rotary + 48.0 * slender;
  const double turning = 0.5 * (a + std::sqrt(a * a - 192.0 * slender / scaling.rotary));
  return std::sqrt(scaling.mass) * length / wave_speed * std::min(1.0, 2.0 / std::sqrt(turning));
}

MeshSteps steps_of(const Scene& scene) {
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  MeshSteps steps = {kInfinite, kInfinite, kInfinite};
  visit_steps_of_walls(scene, [&steps](const WallBlock&, int, double alone, double stable) {
    steps.stable = std::min(steps.stable, stable);
    steps.of_elements = std::min(steps.of_elements, alone);
  });
  steps.accurate = (scene.section.force_based ? kForceBasedStepFraction : kStepFraction) * steps.stable;
  return steps;
}

TimeStep time_step_of(const SceneSpec& spec, const MeshMeasures& mesh, const ContactLaw& contact,
                      const Plates& plates) {
  if (spec.numerics.time_step_s > 0.0) {
    return {spec.numerics.time_step_s, StepBound::asked_for};
  }
  TimeStep step = {mesh.steps.accurate, StepBound::elements};
  const auto hold_to = [&step](double seconds, StepBound bound) {
    if (seconds < step.seconds) {
      step = {seconds, bound};
    }
  };
  if (plates.present) {
    hold_to(kTravelPerStep * mesh.thinnest_wall / plates.speed, StepBound::plate_travel);
    if (spec.section.formulation == SectionSpec::Formulation::force_based) {
      hold_to(kTurnPerStep * mesh.shortest_element / plates.speed, StepBound::plate_travel);
    }
  }
  if (contact.present || mesh.rigid_walls) {
    hold_to(kTravelPerStep * mesh.thinnest_wall / impact_speed_of(spec, mesh), StepBound::approach);
    const double lightest = mesh.lightest_mass;
    hold_to(kStepFraction * contact_step_of(contact, lightest), StepBound::contacts);
    if (mesh.pressed_share > 2.0) {  // the squares of the frequencies of elements and contacts add at most
      const double of_contacts = striker_step_of(contact, lightest, mesh.pressed_share);
      hold_to(kStepFraction / std::hypot(1.0 / mesh.steps.stable, 1.0 / of_contacts), StepBound::contacts);
    }
    if (mesh.walls_along_crush) {
      const double phase = phase_of_stacks(mesh.material, plates.speed, *spec.elements_per_wall);
      hold_to(phase * std::sqrt(lightest / contact.stiffness), StepBound::stacked_walls);
    }
  }
  return step;
}

}  // namespace cellcrush

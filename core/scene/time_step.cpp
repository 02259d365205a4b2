#include "scene/time_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "scene/contact_law.h"

namespace cellcrush {
namespace {

constexpr double kTravelPerStep = 0.05;  // travel of the plate as a fraction of the thinnest wall

/// Whether walls lie along the crush and are stacked in that direction.
bool stacks(const SceneSpec& spec) {
  return std::holds_alternative<SquareLattice>(spec.lattice) || std::holds_alternative<TriangleLattice>(spec.lattice);
}

/// Greatest phase angle omega dt of the lightest particle on its contact, rad. It is less where the crush is slow
/// against sqrt(sigma_y / rho), and its work therefore small.
double phase_of_stacks(const Material& material, double plate_speed) {
  constexpr double kPhase = 0.11;
  constexpr double kFast = 0.45;  // speed over sqrt(sigma_y / rho)
  constexpr double kLeastShare = 1.0 / 3.0;
  const double speed = plate_speed / std::sqrt(material.yield_stress / material.density);
  return kPhase * std::clamp(speed / kFast, kLeastShare, 1.0);
}

}  // namespace

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

TimeStep time_step_of(const SceneSpec& spec, const MeshMeasures& mesh, const ContactLaw& contact,
                      const Plates& plates) {
  if (spec.numerics.time_step_s > 0.0) {
    return {spec.numerics.time_step_s, StepBound::asked_for};
  }
  TimeStep step = {kStepFraction * mesh.stable_step, StepBound::elements};
  const auto hold_to = [&step](double seconds, StepBound bound) {
    if (seconds < step.seconds) {
      step = {seconds, bound};
    }
  };
  if (plates.present) {
    hold_to(kTravelPerStep * mesh.thinnest_wall / plates.speed, StepBound::plate_travel);
  }
  if (contact.present) {
    const double lightest = mesh.lightest_mass;
    hold_to(kStepFraction * contact_step_of(contact, lightest), StepBound::contacts);
    if (stacks(spec)) {
      hold_to(phase_of_stacks(mesh.material, plates.speed) * std::sqrt(lightest / contact.stiffness),
              StepBound::stacked_walls);
    }
  }
  return step;
}

}  // namespace cellcrush

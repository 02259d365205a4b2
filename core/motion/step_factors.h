#pragma once

#include "cellcrush/scene.h"

namespace cellcrush {

/// Factors of the central differences, from the step and the mass damping alpha (E2).
struct StepFactors {
  double step;          ///< dt, s
  double keep;          ///< (1 - a) / (1 + a), the fraction of a velocity that remains
  double gain;          ///< dt / (1 + a), s, the time during which a force accelerates
  double half_damping;  ///< alpha / 2, 1/s
};

/// Mass damping -alpha m v acts on the mean of the velocities half a step before and half a step after. It is then
/// second-order accurate, and stable for any alpha.
inline StepFactors step_factors_of(const Scene& scene) {
  const double step = scene.schedule.time_step;
  const double damping = 0.5 * scene.mass_damping * step;
  return {step, (1.0 - damping) / (1.0 + damping), step / (1.0 + damping), 0.5 * scene.mass_damping};
}

/// The first particle that belongs to no rigid body.
inline std::size_t first_free_particle(const Scene& scene) {
  return static_cast<std::size_t>(scene.rigid.particle_count());
}

}  // namespace cellcrush

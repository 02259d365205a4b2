#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "motion/motion_works.h"

namespace cellcrush {

/// Motion of the impact plate over a step; it does not depend on the lattice.
struct PlateStep {
  /// In mm, over the interval of the work of the forces: half a step before and half a step after them.
  double displacement = 0.0;
  double travel = 0.0;  ///< mm, at the end of the step
};
PlateStep plate_step_of(const Scene& scene, double time, double travel);

/// The works of the force of a plate or rigid wall over a mean displacement along it, mm (E10). What it exerts on
/// particles is among the contact forces.
MotionWorks plate_works(const PlateForce& force, double displacement);

/// Accumulates the work and the impulses of the forces of the plates over a step, and moves the impact plate.
void accumulate_plates(const Scene& scene, const PlateStep& plates, State& state);

}  // namespace cellcrush

#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "motion/motion_works.h"

namespace cellcrush {

/// The works of the newest forces on all particles over the half step up to the time of the state, and twice the
/// kinetic energy at that time (E10).
MotionWorks half_step_works(const Scene& scene, const State& state);

/// Elastic energy of all elements, N mm, from the current stresses (E10). Accepts any section rule.
double elastic_energy(const Scene& scene, const State& state);

}  // namespace cellcrush

#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "motion/motion_works.h"

namespace cellcrush {

/// The works of the newest forces of the rigid walls over half of their ways from one time to another, s: as velocities
/// are at half steps (E10), forces work on half of the steps before and after them. Walls move along their normals, so
/// friction does no work on them.
MotionWorks rigid_wall_works(const Scene& scene, const State& state, double from, double to);

/// Accumulates the works and impulses of the forces of the rigid walls at `time`, s, over the step from there on.
void accumulate_rigid_walls(const Scene& scene, double time, State& state);

}  // namespace cellcrush

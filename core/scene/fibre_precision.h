#pragma once

#include "scene/mesh_part.h"
#include "scene/run_plan.h"

namespace cellcrush {

/// Most steps in which the loading may take a wall to yield with fibre stresses in single precision. In each step, a
/// stress near yield is rounded by at most 2^-24 of the yield stress. Where nothing vibrates, it may be rounded to the
/// same side in every step: by 0.18 % of the yield stress over these steps. A pulled bar has 0.02 %, but 0.64 % over a
/// million steps.
inline constexpr double kMostSingleSteps = 30'000.0;

/// Steps in which the loading takes a wall to yield. For a frame, all steps of its run: its loads may rise until its
/// end. In a lattice that is crushed evenly by the nominal strain e, bending strains the walls by about 3 e h / L,
/// with the wall thickness h and the side L. REQUIRES: a plan without problems.
double steps_to_yield(const SceneSpec& spec, const MeshMeasures& mesh, const RunPlan& plan);

}  // namespace cellcrush

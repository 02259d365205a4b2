#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"
#include "scene/mesh_part.h"

namespace cellcrush {

/// How a mesh is crushed.
struct RunPlan {
  ContactLaw contact;
  Plates plates;  ///< all but the positions of their faces
  Schedule schedule;
};

/// Plans the run of a spec on its mesh. Adds the problems that only the mesh reveals: an unstable step, walls that
/// cross or stand in a rigid wall before loading, too many steps. The plan is valid only if there are no problems.
RunPlan plan_run(const SceneSpec& spec, const MeshMeasures& mesh, Problems& problems);

/// Whether any problem of a spec prevents its mesh from being built.
bool prevents_meshing(const Problems& problems);

/// Most steps in which the loading may take a wall to yield with fibre stresses in single precision. In each step, a
/// stress near yield is rounded by at most 2^-24 of the yield stress. Where nothing vibrates, it may be rounded to the
/// same side in every step: by 0.18 % of the yield stress over these steps. A pulled bar has 0.02 %, but 0.64 % over a
/// million steps.
inline constexpr double kMostSingleSteps = 30'000.0;

/// Steps in which the loading takes a wall to yield. Without plates, all steps of the run: loads may rise until its
/// end. In a lattice that is crushed evenly by the nominal strain e, bending strains the walls by about 3 e h / L,
/// with the wall thickness h and the side L. REQUIRES: a plan without problems.
double steps_to_yield(const SceneSpec& spec, const MeshMeasures& mesh, const RunPlan& plan);

}  // namespace cellcrush

#pragma once

#include "cellcrush/problem.h"
#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"
#include "scene/mesh_part.h"

namespace cellcrush {

/// How a mesh is crushed.
struct RunPlan {
  ContactLaw contact;
  Plates plates;  ///< all but where their faces are
  Schedule schedule;
};

/// Plans the run of a spec on its mesh. Adds what only the mesh tells to the problems of the spec: an unstable step,
/// walls that lie in each other, too many steps. The plan is one only when there are none.
RunPlan plan_run(const SceneSpec& spec, const MeshMeasures& mesh, Problems& problems);

/// Whether any problem of a spec keeps its mesh from being built.
bool prevents_meshing(const Problems& problems);

}  // namespace cellcrush

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
/// overlap before loading, too many steps. The plan is valid only if there are no problems.
RunPlan plan_run(const SceneSpec& spec, const MeshMeasures& mesh, Problems& problems);

/// Whether any problem of a spec prevents its mesh from being built.
bool prevents_meshing(const Problems& problems);

}  // namespace cellcrush

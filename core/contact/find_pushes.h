#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"
#include "parallel/workers.h"

namespace cellcrush {

/// Overwrites ContactWorkspace::pushes by the touches that push, by ball, segments ascending: of touching segments that share
/// a node only the deepest. Reads the touches.
void find_pushes(const Scene& scene, const State& state, ContactWorkspace& workspace, Workers& workers);

}  // namespace cellcrush

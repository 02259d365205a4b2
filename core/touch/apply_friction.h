#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "touch/contact_workspace.h"

namespace cellcrush {

/// Overwrites the friction of all that touch by that of the active contacts (Eq. 44-47, touch/friction.h), and adds the
/// forces to friction_force. REQUIRES: normal forces of this step in ContactWorkspace::active.
void apply_friction(const Scene& scene, State& state, TouchMemory& touching, const ContactWorkspace& workspace);

}  // namespace cellcrush

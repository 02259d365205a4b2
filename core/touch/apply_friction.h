#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "touch/contact_workspace.h"

namespace cellcrush {

/// Overwrites the friction of all touches by that of the active contacts (Eq. 44-47, E9b, touch/force_laws.h), and adds
/// the forces to friction_force. REQUIRES: ContactWorkspace::active has the normal forces of this step.
void apply_friction(const Scene& scene, State& state, TouchMemory& touching, const ContactWorkspace& workspace);

}  // namespace cellcrush

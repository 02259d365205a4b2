#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "touch/contact_workspace.h"

namespace cellcrush {

/// Adds the normal forces of the active contacts to contact_force and their stored energy to the totals (Eq. 43, E8,
/// E8b). Keeps each normal force for friction.
void apply_normal_forces(const Scene& scene, State& state, const TouchMemory& touching, ContactWorkspace& workspace,
                         ContactTotals& totals);

}  // namespace cellcrush

#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"

namespace cellcrush {

/// Adds the normal forces of the pushes to contact_force and what they store to the totals, and notes what of each force
/// friction goes by.
void apply_normal_forces(const Scene& scene, State& state, const TouchMemory& touching, ContactWorkspace& workspace,
                         ContactTotals& totals);

}  // namespace cellcrush

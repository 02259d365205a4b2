#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"

namespace cellcrush {

/// Adds the normal forces of the pushes, and notes what of each friction goes by, with the processor's vector instructions:
/// both forces on a particle at once. The same bits as without.
void apply_normal_forces_wide(const Scene& scene, State& state, const TouchMemory& touching,
                              ContactWorkspace& workspace, ContactTotals& totals);

}  // namespace cellcrush

#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"
#include "parallel/workers.h"

namespace cellcrush {

/// Overwrites impact_force and support_force, of the rigid, unilateral plates on every particle whose ball reaches into
/// them, by the penalty law of the walls, and adds them to contact_force, as evaluate_contact_forces does. Forces are positive in compression: the impact plate pushes along the crush, the support plate
/// against it. Friction acts across the crush; it is added to friction_force.
///
/// All particles are held against the plates, eight at a time; of those few that reach a plate, or that leave it in this step
/// with some friction, are the forces evaluated.
void evaluate_plate_forces(const Scene& scene, State& state, ContactWorkspace& workspace, Workers& workers);

}  // namespace cellcrush

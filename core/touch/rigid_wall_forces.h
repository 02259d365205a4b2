#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"

namespace cellcrush {

/// Adds the forces of the rigid walls of a frame on the particles `first` ... `end` - 1 to contact_force,
/// friction_force and the sums, by the law of the plates (E9c to E9f, touch/face_forces.h). The walls stand where they
/// are at the time of the state.
void evaluate_rigid_wall_forces(const Scene& scene, State& state, int first, int end, ContactSums& sums);

}  // namespace cellcrush

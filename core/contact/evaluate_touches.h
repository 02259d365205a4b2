#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"
#include "parallel/workers.h"

namespace cellcrush {

/// Overwrites how the pairs of State::touching stand to each other (contact/capsule.h), their free viscous force and their
/// slip, and keeps the sides up to date: a pair that is new, and a ball beyond an end of its segment, is on the side where it
/// stands. Overwrites State::parted by the pairs that touch no more; their candidates are tested again from now on.
void evaluate_touches(const Scene& scene, State& state, ContactWorkspace& workspace, Workers& workers);

}  // namespace cellcrush

#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Overwrites load_force and load_moment by gravity, nodal loads and element loads at the time of the state (P, Q, p, q
/// of Eq. 4; E14).
void evaluate_loads(const Scene& scene, State& state);

/// Gives every joint of a pin an equal share of the forces on all of them, those of walls, loads and contacts (E16). As
/// their masses are equal too, they all move by the same numbers. Moments stay with their joints.
/// REQUIRES: forces of walls, loads, contacts, plates and half planes are evaluated.
void share_pin_forces(const Scene& scene, State& state);

}  // namespace cellcrush

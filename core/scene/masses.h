#pragma once

#include "cellcrush/scene.h"

namespace cellcrush {

/// Fills masses, inertias, their inverses, radius, largest_radius, smallest_radius and total_mass of the scene from its
/// elements (Eq. 1-3, E1). Each element gives half of its mass rho b h l to either node, and that mass times gamma^2 =
/// h^2 / 12 as rotary inertia, both scaled by mass_scaling (E11b). A node between a pair of elements has no rotation
/// (E5b); its rotary inertia goes to the other ends of both. Joints of a pin share their mass (E16). Adds to the
/// present values, so attached masses are entered before.
void lump_masses(Scene& scene);

/// Fills centres, masses and inertias of the bodies (M and I of E13). REQUIRES: masses are lumped.
void lump_rigid_bodies(Scene& scene);

}  // namespace cellcrush

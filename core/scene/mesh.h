#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"
#include "lattice/layout.h"

namespace cellcrush {

/// Position at a share of a wall, which may be an arc or bowed to half a sine wave.
Vector2 place_on(const Layout& layout, const LayoutWall& wall, double share);

/// Rise of the arc over the chord between two shares of a curved wall, mm.
double rise_between(const Layout& layout, const LayoutWall& wall, double from, double to);

/// Divides the walls into elements: fills the positions, elements and walls of the scene. Joints come first, then the
/// particles inside the walls, block by block. Consecutive walls with the same number of elements share a block. Each
/// rigid wall is one element, after all others. REQUIRES: rigid walls are the last ones.
void divide_walls(const Layout& layout, Scene& scene);

/// Fills the flexibilities in shear (E5i), if the section shears. `materials` are those of the scene.
void let_walls_shear(const std::vector<MaterialSpec>& materials, Scene& scene);

/// Fills first_joint and end_joint of every chunk, so that the former is not before the latter of the chunk before.
void order_joints(Walls& walls, int joint_count);

/// Fills incidence_offset, incidence, wall_end_offset and wall_ends.
void link_elements(Scene& scene);

/// Fills masses, inertias, their inverses, radius, largest_radius, smallest_radius and total_mass of the scene from its
/// elements (Eq. 1-3, E1). Each element gives half of its mass rho b h l to either node, and that mass times gamma^2 =
/// h^2 / 12 as rotary inertia, both scaled by mass_scaling (E11b). A node between a pair of elements has no rotation
/// (E5b); its rotary inertia goes to the other ends of both. Joints of a pin share their mass (E16). Adds to the
/// present values, so attached masses are entered before.
void lump_masses(Scene& scene);

/// What a wall gives to the joint at either of its ends.
struct EndShare {
  double mass = 0.0;     ///< tonne
  double inertia = 0.0;  ///< tonne mm^2
};
EndShare share_of_end(const Scene& scene, int wall, const WallBlock& block, bool at_end);

/// Fills centres, masses and inertias of the bodies (M and I of E13). REQUIRES: masses are lumped.
void lump_rigid_bodies(Scene& scene);

}  // namespace cellcrush

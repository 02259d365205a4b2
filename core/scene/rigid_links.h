#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

// Rigid links (E13). Where three walls of thickness h meet at 120 degrees, each joint covers 0.29 h of a wall, and
// where four meet at 90 degrees, half of h. A wall that is no longer than its thickness is thus the material of its
// joint, not a beam. As a beam it would set the time step, which falls with the square of the length. As a rigid link
// it moves with its joint: a rigid body (E13) that keeps its place, mass and rotary inertia.
//
// The alternative, mass added to short walls, was not kept. A wall needs n times the mass of a wall that is n times as
// long to have its step: a stub of a hundredth of the length, the mass of a hundred walls.

/// Greatest share of the mass of all walls that rigid links may have.
inline constexpr double kMostLinkMass = 0.01;

/// A frame or network whose rigid links are its last walls. The nodes of the links come first, body by body.
struct LinkedSpec {
  SceneSpec spec;
  ListOrder order;  ///< empty if there are no links
  int links = 0;
};

/// Finds the rigid links of a frame or network and puts them in order. A straight wall is a link if it is shorter than
/// numerics.rigid_link_slenderness times its thickness; nothing holds, moves or pins its ends and no distributed load
/// is on it; and all links that are joined to it lie within as short a distance. Where they do not, the limit is halved
/// until they do, so that a wall which is listed in short pieces bends. The limit of all is halved until the links have
/// at most kMostLinkMass of the mass. Other lattices are returned as they are: their walls are longer.
/// REQUIRES: a checked spec.
LinkedSpec put_rigid_links_first(const SceneSpec& spec);

/// Mass of the rigid links over that of all walls.
double link_mass_share_of(const Scene& scene);

/// The listed wall to which an element belongs, as an index into the list.
int listed_wall_of(const Scene& scene, int element);

}  // namespace cellcrush

#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"
#include "lattice/layout.h"

namespace cellcrush {

/// Joints and walls of an explicit frame; joint i is node i, and the joints of pinned ends follow (E16). Walls
/// have material 0. Beams with a material of their own have 1, 2, ... in the order of the beams. The last `links` beams
/// are rigid links. REQUIRES: a checked frame, its links in order (scene/rigid_links.h).
Layout lay_out_frame(const FrameWalls& frame, int elements_per_wall, int links);

/// Adds the attached masses, supports, pins and watched nodes of a frame, and what acts on its nodes and beams, to the
/// scene. `order` tells the beam of each wall. REQUIRES: the mesh of the scene is that of the frame; lump_masses has
/// not run yet.
void attach_to_frame(const FrameWalls& frame, const ListOrder& order, const LoadsSpec& loads, Scene& scene);

/// Gives all joints of a pin equal shares of its mass. REQUIRES: masses of elements are lumped.
void share_pin_masses(Scene& scene);

}  // namespace cellcrush

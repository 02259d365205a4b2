#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"
#include "lattice/layout.h"

namespace cellcrush {

// Pinned ends of a frame's beams (E16). A pinned end is a joint of its own at the place of its node, so that it has a
// rotation of its own. The joints of a pin have the node's translation in common: all of them have equal shares of the
// mass and of the force of the whole pin, and so move by the same numbers (motion/pin_forces.h).

/// Adds the joints of pinned ends after those of the nodes, in the order of the beams, and attaches the ends to them.
/// REQUIRES: the layout has the nodes and the beams of the frame, in their order.
void add_pinned_ends(const FrameWalls& frame, Layout& layout);

/// Fills the pins of the scene, and holds all joints of a pin in x and y as its node is held.
/// REQUIRES: the mesh of the scene is that of the layout; the nodes' supports are attached.
void group_pinned_ends(const FrameWalls& frame, Scene& scene);

/// Gives all joints of a pin equal shares of its mass. REQUIRES: masses of elements are lumped.
void share_pin_masses(Scene& scene);

}  // namespace cellcrush

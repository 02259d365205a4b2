#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"
#include "scene/mesh.h"

namespace cellcrush {

/// Joints and walls of an explicit frame; joint i is node i. Walls have material 0, or, where their beam has its own,
/// 1, 2, ... in the order of the beams. REQUIRES: a checked frame.
Layout lay_out_frame(const FrameLattice& frame, int elements_per_wall);

/// Puts a frame's attached masses, supports, motions, loads, gravity, initial velocities and watched nodes on the
/// scene. REQUIRES: the scene's mesh is that of the frame; lump_masses has not run yet.
void attach_to_frame(const FrameLattice& frame, Scene& scene);

}  // namespace cellcrush

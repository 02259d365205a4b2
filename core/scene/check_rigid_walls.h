#pragma once

#include "cellcrush/scene_spec.h"
#include "scene/check_spec.h"

namespace cellcrush {

/// Checks the rigid walls of a frame: normals with a direction, motions with times in order, no ball inside a wall at
/// time 0 (E9f), and no pinned ends, whose balls would stand at one place several times.
void check_rigid_walls(const FrameLattice& frame, FieldChecker& check);

}  // namespace cellcrush

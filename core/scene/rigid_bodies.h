#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "scene/mesh.h"

namespace cellcrush {

/// Numbers the joints of rigid walls first, with those of the same body side by side, and moves rigid walls to the end.
/// Returns RigidBodies::offset.
std::vector<int> put_rigid_bodies_first(Layout& layout);

/// Fills centres, masses and inertias of the bodies (M and I of E13). REQUIRES: masses are lumped.
void lump_rigid_bodies(Scene& scene);

}  // namespace cellcrush

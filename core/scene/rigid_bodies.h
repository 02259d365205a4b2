#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "scene/mesh.h"

namespace cellcrush {

/// Numbers the joints of rigid walls first, those that rigid walls join together side by side, and puts rigid walls
/// last. Returns RigidBodies::offset.
std::vector<int> put_rigid_bodies_first(Layout& layout);

/// Fills in centres, masses and inertias of the bodies. REQUIRES: masses are lumped.
void lump_rigid_bodies(Scene& scene);

}  // namespace cellcrush

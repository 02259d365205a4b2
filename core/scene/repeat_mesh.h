#pragma once

#include <memory>

#include "cellcrush/scene.h"

namespace cellcrush {

// The mesh of Scene::repeated: contact/repeated_mesh.h has its use.

/// The mesh with its copies, the furthest on the low side first: its N particles start at Scene::first_ball. Of E
/// elements, number e % E of the mesh is e, those of the mesh come first. REQUIRES: sides that repeat, no rigid bodies.
std::shared_ptr<Scene> repeat_mesh(const Scene& scene);

/// The overlaps of walls of the repeated mesh before loading, of its own balls only, and the same in the numbers of the
/// mesh.
StartOverlaps overlaps_of_balls(const Scene& repeated, const StartOverlaps& all);
StartOverlaps original_overlaps(const Scene& scene, const StartOverlaps& of_balls);

}  // namespace cellcrush

#pragma once

#include <vector>

#include "cellcrush/scene.h"

namespace cellcrush {

/// The nodes of a wall from its start to its end; `wall` has its elements in order.
std::vector<int> nodes_of(const Scene& scene, const std::vector<int>& wall);

/// Makes the nodes of every beam follow random paths over some steps, the same everywhere: elements stretch, are
/// squashed, bend, drift and turn many times. The rotations of nodes without one have no effect.
void impose_random_motions(Scene& scene, int steps);

}  // namespace cellcrush

#pragma once

#include "cellcrush/scene_spec.h"
#include "lattice/layout.h"

namespace cellcrush {

/// Joints and undivided walls of a network in the order of its lists. The last walls are rigid links.
/// REQUIRES: a checked network.
Layout lay_out_network(const NetworkWalls& network, int links = 0);

/// Whether its joints have more than three walls in the mean, so that it bears by stretching its walls. These are then
/// stacked along the crush, as those of squares and triangles are.
bool has_stacked_walls(const NetworkWalls& network);

}  // namespace cellcrush

#pragma once

#include <utility>
#include <vector>

#include "lattice/layout.h"

namespace cellcrush {

// Joints that have a size (section.rigid_joints). Where walls meet, the metal between the corners of their faces is
// part of several walls and hardly bends. A wall is then free between its arms alone: of two walls of thickness h and
// h' that meet at an angle phi, the faces meet at (h' + h cos phi) / (2 sin phi) along the wall of thickness h. The arm
// of an end is the mean over both sides of the wall, 0 on a side where it has no neighbour within 180 degrees. For
// regular hexagons it is h / (2 sqrt 3), which makes the free length the l - h / (2 cos 30) of closed forms with joints
// (Malek and Gibson, 2015). Such joints are an upper bound of stiffness: real ones deform too.

/// Length of the arm of each end of each wall, over its chord: start, then end. At most 0.4; 0 for rigid walls.
std::vector<std::pair<double, double>> arms_of(const Layout& layout);

/// Makes a rigid wall of each arm, behind all others, up to a new joint behind all others. In the lists (Layout::order)
/// it counts as its wall.
void add_rigid_joints(Layout& layout);

}  // namespace cellcrush

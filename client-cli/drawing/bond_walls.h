#pragma once

#include <vector>

#include "drawing/drawing.h"

namespace cellcrush::drawing {

// Foils that lie face to face and are bonded, as the double walls of an expanded honeycomb: drawn as two lines, a
// thickness apart, they are one wall of both thicknesses.

/// Default share of the mean thickness by which the distance of bonded mid-lines may differ from it.
inline constexpr double kBondTolerance = 0.05;

/// Where two walls became one.
struct Bond {
  DrawnPlace middle;
  double length = 0.0;
  double thickness = 0.0;
};

/// Replaces what lies face to face of straight walls by single walls in the middle, as thick as both together; stacks
/// of foils one after the other. Two walls are face to face if both ends of the other lie, to a share of the mean of
/// their thicknesses, at that distance from the line of the first, on one side, over more than that length. Walls that
/// end within that length of each other end as one; what a wall has beyond remains. Ends of walls that lay on bonded
/// parts, arcs too, go with them. Returns the bonds. Lengths in one unit. REQUIRES: every wall has a thickness.
std::vector<Bond> bond_walls(double share, std::vector<DrawnWall>& walls);

}  // namespace cellcrush::drawing

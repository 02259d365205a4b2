#pragma once

#include "cellcrush/scene_spec.h"
#include "lattice/layout.h"

namespace cellcrush {

/// Multiplies the thickness of every wall by 1 + a u, with u uniformly distributed between -1 and 1 and a the scatter.
void scatter_thicknesses(const Defects& defects, Layout& layout);

/// What defects have removed.
struct Removal {
  int walls = 0;
  int free_ends = 0;  ///< joints of one wall that had more
};

/// Removes a fraction of the walls at random. Walls whose absence would leave two parts are passed over, so that the
/// rest stays connected: a closed cell or a free end always has a wall that can go. Draws are independent of those of
/// the thicknesses.
Removal remove_walls(const Defects& defects, Layout& layout);

}  // namespace cellcrush

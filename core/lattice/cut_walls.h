#pragma once

#include <vector>

#include "cellcrush/vector.h"
#include "lattice/layout.h"

namespace cellcrush {

/// Corners of a polygon in order; the last one is joined to the first one.
using Polygon = std::vector<Vector2>;

struct Box {
  Vector2 low;
  Vector2 high;
};

/// REQUIRES: at least one place.
Box box_around(const std::vector<Vector2>& places);

Polygon rectangle_between(const Vector2& corner, const Vector2& opposite);

/// Walls that were left out because a cut separated them from the rest.
struct Islands {
  int count = 0;
  int walls = 0;
};

/// Keeps what lies inside a polygon or on it, with the thickness of edge walls between the cut ends; 0 for none. Of
/// each connected part of the walls, the part of most walls is kept. Walls and gaps shorter than a thousandth of the
/// mean wall become one joint.
/// REQUIRES: straight walls.
Islands cut_at(const Polygon& polygon, double edge_wall_thickness, Layout& layout);

/// Leaves out walls that `is_kept` says 0 of, and joints without walls.
void keep_walls(const std::vector<char>& is_kept, Layout& layout);

}  // namespace cellcrush

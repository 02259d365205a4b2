#pragma once

#include <string>

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"
#include "cellcrush/vector.h"

namespace cellcrush {

/// Cost from which `cellcrush check` notes a wall.
inline constexpr double kCostlyWall = 3.0;

/// The wall that sets the stable step (E11b, E11c), and what it costs.
struct SlowestWall {
  int listed = 0;          ///< into the walls or beams of the case
  int elements = 0;        ///< of the wall
  double length = 0.0;     ///< mm, along its elements
  double thickness = 0.0;  ///< mm
  Vector2 middle = Vector2::Zero();
  double cost = 1.0;  ///< how many times as long a step half of the walls allow
};
SlowestWall slowest_wall_of(const Scene& scene);

/// "0.02 mm long and 0.2 mm thick, in 2 elements, at (1, 2) mm".
std::string words_of(const SlowestWall& slowest);

/// find_costly_walls() of a run whose step has this bound.
Problems note_costly_wall(const SceneSpec& spec, const SlowestWall& slowest, StepBound bound);

/// "6900", a number of times in two digits.
std::string times_text(double times);

}  // namespace cellcrush

#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// The material of a lattice in columns across the crush, numbered from the impact end. A particle belongs to the two
/// columns nearest to its undeformed position, in shares by the lever rule. A uniform strain is then found exactly, and
/// no column depends on the round-off of a position on its border. K columns, N particles.
struct Columns {
  std::vector<double> place;      ///< K, mm, mean distance of the mass from the impact end, undeformed
  std::vector<double> mass;       ///< K, tonne
  std::vector<double> wall_area;  ///< K, mm^2, length times thickness of the walls, undeformed
  std::vector<int> lower;         ///< N, the nearest column at or below the particle; never the last
  std::vector<double> share;      ///< N, fraction of the particle that belongs to the column above `lower`
  int axis = 0;                   ///< crush direction
  double begin = 0.0;             ///< mm, position of the impact end along the crush, undeformed
};

/// Columns at a spacing of one cell. `pitch`: mean extent of a cell along the crush, mm. REQUIRES: a scene with plates.
Columns divide_into_columns(const Scene& scene, double pitch);

/// Displacements and velocities of the columns.
struct Profile {
  std::vector<double> displacement;  ///< K, mm along the crush, mean over the mass
  std::vector<double> velocity;      ///< K, mm/s along the crush, mean over the mass
};
Profile measure_columns(const Columns& columns, const Scene& scene, const State& state);

/// Length times thickness of the walls now, mm^2 (K). REQUIRES: the lengths in the state are those of its positions.
std::vector<double> measure_walls(const Columns& columns, const Scene& scene, const State& state);

}  // namespace cellcrush

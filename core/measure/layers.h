#pragma once

#include <optional>
#include <vector>

#include "cellcrush/sample.h"
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

// The front of a fast crush, found from the motion of the cells alone. The strain between two columns is the difference
// of their mean displacements over that of their positions. The step function that fits these strains best in the sense
// of least squares gives a possible front. The kColumnsOfFront gaps on either side of it belong to neither side.
//
// The strain behind is the mean from the impact end to the front. The strain ahead is the mean from the front to the
// middle of the material ahead, because cells that collapse at the support do not belong to the front. Velocities are
// mass averages over all material behind and over all material ahead; the latter is what the support feels. The
// position of the front follows from both strains and the shortening up to that middle.
//
// There is a front if the crush is a step and nothing else:
//  - at least kColumnsBeside columns are left behind the front, and as many between it and the middle ahead;
//  - the strain falls by at least kLeastJump;
//  - on neither side does the strain scatter (root mean square) by more than kMostScatter of that jump;
//  - the velocity falls by at least kLeastVelocityJump of the speed of the plate.
// By this rule, a slow crush in oblique bands has no front: its columns are crushed only in part and still deform
// behind the band.

inline constexpr int kColumnsOfFront = 2;
inline constexpr int kColumnsBeside = 3;
inline constexpr double kLeastJump = 0.3;
inline constexpr double kMostScatter = 0.05;
inline constexpr double kLeastVelocityJump = 0.8;

/// The jump across the front; nothing if there is none. REQUIRES: the lengths in the state are those of its positions.
std::optional<Front> find_front(const Columns& columns, const Scene& scene, const State& state);

/// Sizes along the crush, mm.
struct LayerSize {
  double depth = 0.0;  ///< of a layer: that of three cells of solid metal, but at least four times the thickest wall
  double reach = 0.0;  ///< half a cell: walls that far from a layer tell how wide it is
};

/// `pitch`: mean extent of a cell along the crush, mm. REQUIRES: a scene with plates.
LayerSize size_of_layers(const Scene& scene, double pitch);

/// Cuts the deformed lattice into equal layers across the crush, at least `size.depth` deep, and finds the one whose
/// solid fraction is greatest: length times thickness (E5f) of its walls over its area. A layer is as wide as the walls
/// in it, in the two beside it and in all within `size.reach`: one that is much thinner than a cell may have a single
/// joint in it. Each half of an element counts where its particle is. Joints count in each of their walls,
/// as in the relative density of thin walls. There are at most as many layers as particles. REQUIRES: finite positions.
DensestLayer find_densest_layer(const Scene& scene, const State& state, const LayerSize& size);

}  // namespace cellcrush

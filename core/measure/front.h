#pragma once

#include <optional>

#include "cellcrush/sample.h"
#include "measure/columns.h"

namespace cellcrush {

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

}  // namespace cellcrush

#pragma once

#include <optional>

#include "cellcrush/sample.h"
#include "measure/columns.h"

namespace cellcrush {

// The front of a fast crush, found from the motion of the cells alone. Between two columns the strain is the difference
// of their mean displacements over that of their places. The step that fits these strains best in the least squares is
// where a front may be. The kColumnsOfFront gaps on either side of it belong to neither side. The strain behind is the
// mean from the impact end to there, the strain ahead the mean from there to the middle of what lies ahead: cells that
// give way at the support are not the front's. Velocities are means over the mass of all that lies behind and of all
// that lies ahead, which is what the support feels. The front's place follows from both strains and the shortening up
// to that middle.
//
// There is a front when the crush is a step and nothing else: at least kColumnsBeside columns are left behind it and up
// to the middle ahead, the strain falls by at least kLeastJump, on neither side does it scatter (root mean square) by
// more than kMostScatter of that jump, and the velocity falls by at least kLeastVelocityJump of the plate's speed. A
// slow crush in oblique bands has no front by this rule: its columns are crushed by parts and still give way behind the
// band.

inline constexpr int kColumnsOfFront = 2;
inline constexpr int kColumnsBeside = 3;
inline constexpr double kLeastJump = 0.3;
inline constexpr double kMostScatter = 0.05;
inline constexpr double kLeastVelocityJump = 0.8;

/// The jump across the front, or nothing where there is none. `relative_density`: of the undeformed lattice. REQUIRES:
/// lengths that are those of the state's positions.
std::optional<Front> find_front(const Columns& columns, const Scene& scene, const State& state,
                                double relative_density);

}  // namespace cellcrush

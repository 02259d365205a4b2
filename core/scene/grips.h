#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"
#include "fields/field_checker.h"
#include "lattice/layout.h"

namespace cellcrush {

/// What a grip of a spec holds: all at or beyond a line along an edge of the lattice.
struct GripLine {
  int axis = 0;           ///< across the line
  double outward = 1.0;   ///< +1: holds what lies higher along the axis; -1: lower
  double place = 0.0;     ///< mm
  double rounding = 0.0;  ///< mm, by which what it holds may lie before the line

  [[nodiscard]] bool holds(const Vector2& point) const { return outward * (point[axis] - place) >= -rounding; }
};

/// The lines of the grips of a spec, for the positions of a lattice with its imperfections. `envelope`: of its joints
/// before these.
std::vector<GripLine> grip_lines_of(const SceneSpec& spec, const Bounds& envelope);

/// Checks the numbers of grips, and that what they are fixed to is there.
void check_grips(const SceneSpec& spec, FieldChecker& check);

/// Holds the particles of the grips of a checked spec, those of the mesh inside walls too. A particle that is held
/// already, or belongs to a rigid body, is counted as taken. REQUIRES: the supports of a frame are attached.
void attach_grips(const SceneSpec& spec, const Bounds& envelope, Scene& scene);

/// Grips that hold nothing, or for which something is taken.
Problems find_grip_problems(const Scene& scene);

}  // namespace cellcrush

#pragma once

#include <string>

#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// Whether the walls of a spec are made from those of a lattice: of a Voronoi honeycomb, or where a lattice has changes
/// (SceneSpec::changes). They are listed as a network then, and meshed as such.
bool has_made_walls(const SceneSpec& spec);

/// A spec whose walls are listed.
struct ListedWalls {
  SceneSpec spec;     ///< a network without changes; the given one if it has no made walls
  std::string words;  ///< what was made of which walls, as a sentence; empty without made walls
  Problems problems;  ///< changes that leave no walls, or too many
};

/// Makes the walls of a spec: rotation, size by the grading, cut at the outline, thickness by the grading, scatter,
/// missing walls; in this order. REQUIRES: no problems that prevent meshing; the fidelity has been filled in.
ListedWalls list_walls(const SceneSpec& spec);

/// Problems of a network name its lists. Those of made walls name the lattice.
void name_made_walls(const SceneSpec& given, Problems& problems);

/// Cosine and sine of an angle in degrees, the same on every machine; exact for multiples of 90 degrees.
struct Turn {
  double cosine = 1.0;
  double sine = 0.0;
};
Turn turn_by(double degrees);

}  // namespace cellcrush

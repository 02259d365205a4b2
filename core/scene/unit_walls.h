#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "lattice/layout.h"

namespace cellcrush {

// Walls that can break (E6g) part at a joint or between two elements. To keep the mesh of the rest as it is, each unit
// of elements that are solved together (E5b), a pair or a single one, is then a wall of its own between joints.

/// Whether walls of some materials can break.
bool can_break(const std::vector<Material>& materials);

/// Replaces each wall by its units, side by side, and adds the joints between them after all others. The units of a
/// curved wall are arcs through three of its points. In the lists (Layout::order) a unit counts as the wall that it is
/// part of.
void divide_into_units(bool force_based, Layout& layout);

/// Fills Scene::chain. REQUIRES: the mesh and the order of the lists of the scene.
void number_chains(Scene& scene);

}  // namespace cellcrush

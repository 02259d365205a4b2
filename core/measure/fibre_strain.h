#pragma once

#include <span>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

// The largest fibre strain of each wall, elastic and plastic together, from the motion of its nodes since the start
// (E17 of core/README.md). The laws keep too little to tell: a perfectly plastic fibre stores its stress alone. Axial
// strain and curvature are those of an element whose curvature is linear, or linear from node to node in a pair whose
// middle does not rotate. That is exact where walls are elastic or bend evenly. The turn of a plastic hinge is spread
// over its element, so the strain there is a mean over the length of an element, and depends on the mesh.

/// The greatest strain of the outer fibres of a wall; magnitude.
struct WallStrain {
  double strain = 0.0;
  int wall = 0;  ///< into Scene::walls
};

/// Of some blocks of walls; strain 0 before any is strained. Values that are not finite are left out.
WallStrain find_largest_fibre_strain(const Scene& scene, const State& state, std::span<const WallBlock> blocks);

/// Overwrites the strains of all walls (Scene::wall_count), by their numbers (MeshView::element_wall).
void evaluate_fibre_strains(const Scene& scene, const State& state, std::vector<float>& strains);

}  // namespace cellcrush

#pragma once

#include "cellcrush/sample.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

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

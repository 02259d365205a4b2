#pragma once

#include "cellcrush/sample.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Depth of layers along the crush, mm: that of three cells of solid metal, but at least four times the thickest wall.
/// `pitch`: mean extent of a cell along the crush, mm. REQUIRES: a scene with plates.
double depth_of_layers(const Scene& scene, double pitch);

/// Cuts the deformed lattice into equal layers across the crush, at least `depth` deep, and finds the one whose solid
/// fraction is greatest: length times thickness (E5f) of its walls over its area. A layer is as wide as the walls in it
/// and in the two beside it. Each half of an element counts where its particle is. Joints count in each of their walls,
/// as in the relative density of thin walls. There are at most as many layers as particles. REQUIRES: finite positions.
DensestLayer find_densest_layer(const Scene& scene, const State& state, double depth);

}  // namespace cellcrush

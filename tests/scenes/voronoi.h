#pragma once

#include <cstdint>

#include "cellcrush/scene_spec.h"

namespace cellcrush::scenes {

/// A raw Voronoi foam: the walls between the cells of random points in a rectangle, without those on its border. All
/// have one thickness, which gives the relative density. Nothing keeps the points apart, so that some walls are far
/// shorter than they are thick. The same seed gives the same foam.
FrameWalls voronoi_foam(double length_mm, double width_mm, int cells, double relative_density, std::uint64_t seed);

}  // namespace cellcrush::scenes

#pragma once

#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// Quasi-static plastic collapse stress of a regular lattice of rigid, perfectly plastic walls, MPa.
/// Hexagons bend: (2/3) sigma_y (h/L)^2 in either direction, with the thickness of the slanted walls (Gibson and Ashby,
/// Cellular Solids, 2nd ed., section 4.3). Squares yield axially: sigma_y h/L. Triangles yield axially: (2/sqrt 3)
/// sigma_y h/L along their walls, carried by the walls along the load; sqrt 3 sigma_y h/L across them, carried by the
/// others. REQUIRES: a checked spec that is not a frame.
double collapse_stress_of(const SceneSpec& spec);

}  // namespace cellcrush

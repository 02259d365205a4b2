#pragma once

#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// Quasi-static plastic collapse stress of a regular lattice of rigid, perfectly plastic walls, MPa.
/// Hexagons bend: (2/3) sigma_y (h/L)^2 in either direction, with the slanted walls' thickness (Gibson and Ashby,
/// Cellular Solids, 2nd ed., section 4.3). Squares yield axially: sigma_y h/L. Triangles yield axially: along their
/// walls (2/sqrt 3) sigma_y h/L, where only the walls along the load bear, across them sqrt 3 sigma_y h/L, where the
/// others do. REQUIRES: a checked spec, and no frame.
double collapse_stress_of(const SceneSpec& spec);

}  // namespace cellcrush

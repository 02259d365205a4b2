#pragma once

#include "cellcrush/sample.h"
#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// Quasi-static plastic collapse stress of regular hexagons, (2/3) sigma_y (h/L)^2 in either direction (Gibson and Ashby,
/// Cellular Solids, 2nd ed., section 4.3), with the thickness of the slanted walls, which alone bend. MPa.
double collapse_stress_of(const HexagonLattice& lattice, double yield_stress);

/// Mass over that of the solid envelope.
double relative_density_of(const Scene& scene);

/// Closed forms beside the result (Eq. 51 with the collapse stress as sigma_0 and densification at 1 - 1.4 relative
/// density, Gibson and Ashby). All 0 for a scene without plates.
Theory theory_of(const Scene& scene);

}  // namespace cellcrush

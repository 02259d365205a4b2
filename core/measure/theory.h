#pragma once

#include "cellcrush/sample.h"
#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// Quasi-static plastic collapse stress of a lattice of rigid, perfectly plastic walls, MPa.
/// Hexagons bend: (2/3) sigma_y (h/L)^2 in either direction, with the slanted walls' thickness (Gibson and Ashby, Cellular
/// Solids, 2nd ed., section 4.3). Squares yield axially: sigma_y h/L. Triangles yield axially: along their walls
/// (2/sqrt 3) sigma_y h/L, where only the walls along the load bear, across them sqrt 3 sigma_y h/L, where the others do.
double collapse_stress_of(const HexagonLattice& lattice, double yield_stress, LoadingSpec::Direction direction);
double collapse_stress_of(const SquareLattice& lattice, double yield_stress, LoadingSpec::Direction direction);
double collapse_stress_of(const TriangleLattice& lattice, double yield_stress, LoadingSpec::Direction direction);

/// Mass over that of the solid envelope.
double relative_density_of(const Scene& scene);

/// Closed forms beside the result (Eq. 51 with the collapse stress as sigma_0 and densification at 1 - 1.4 relative
/// density, Gibson and Ashby). All 0 for a scene without plates.
Theory theory_of(const Scene& scene);

}  // namespace cellcrush

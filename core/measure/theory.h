#pragma once

#include "cellcrush/sample.h"
#include "cellcrush/scene.h"

namespace cellcrush {

/// Mass over that of the solid envelope.
double relative_density_of(const Scene& scene);

/// Closed-form solutions to compare a result with (Eq. 51, with the collapse stress as sigma_0 and densification at 1 -
/// 1.4 relative density, Gibson and Ashby). All 0 for a scene without plates.
Theory theory_of(const Scene& scene);

}  // namespace cellcrush

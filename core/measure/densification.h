#pragma once

#include <optional>

#include "measure/curve.h"

namespace cellcrush {

/// Onset of densification: the strain at which the energy-absorption efficiency
///   eta(eps) = (1 / sigma) integral_0^eps sigma d eps
/// is greatest at the foot of the lasting rise. The curve is smoothed over Curve::kSmoothing.
///
/// The greatest eta of the whole curve is no onset if the stress dips. It does so after the first wave of a fast crush
/// and between the collapses of two layers. The rise is therefore found first, beyond kPlateauBegins. It begins at the
/// strain r, at least kLeastRise, from which sigma
///   - stays above kRise times the mean since kPlateauBegins,
///   - stays above kAbovePeaks times the greatest stress of the plateau,
///   - for at least kLasts of strain.
/// The foot is the last point before r at which sigma was at the mean of the plateau. Returns nothing without such a
/// rise: the crush has not densified, or ends too early to tell. `curve`: of both plates, for a crush at any speed.
std::optional<double> find_densification(const Curve& curve);

}  // namespace cellcrush

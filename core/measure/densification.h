#pragma once

#include <optional>

#include "measure/curve.h"

namespace cellcrush {

/// Onset of densification: the strain at which the energy-absorption efficiency
///   eta(eps) = (1 / sigma) integral_0^eps sigma d eps
/// is greatest at the foot of the rise that lasts. sigma is the curve smoothed over Curve::kSmoothing.
///
/// The greatest eta of the whole curve is no onset where stress dips, as it does after the first wave of a fast crush
/// or between the collapses of two layers. So the rise is found first, beyond kPlateauBegins: from its strain r on, r
/// at least kLeastRise, sigma
///   - stays above kRise times the mean since kPlateauBegins,
///   - stays above kAbovePeaks times all that the plateau bore,
///   - for kLasts of strain or more.
/// The foot is where sigma was at the plateau's mean for the last time before r. Nothing without such a rise: the crush
/// has not densified, or ends too soon to tell. `curve`: of both plates, for a crush of any speed.
std::optional<double> find_densification(const Curve& curve);

}  // namespace cellcrush

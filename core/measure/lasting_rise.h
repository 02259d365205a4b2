#pragma once

#include <functional>
#include <optional>
#include <span>

#include "cellcrush/sample.h"
#include "cellcrush/scene.h"
#include "measure/curve.h"

namespace cellcrush {

// The lasting rise of the stress that ends the plateau. The strain at which the energy-absorption efficiency
//   eta(eps) = (1 / sigma) integral_0^eps sigma d eps
// is greatest at the foot of the rise is its onset. The curve is smoothed over Curve::kSmoothing.
//
// The greatest eta of the whole curve is no onset if the stress dips. It does so after the first wave of a fast crush
// and between the collapses of two layers. The rise is therefore found first, beyond a strain of 0.2, where the plateau
// begins. It begins at the strain r, at least 0.3, from which sigma
//   - stays above 1.3 times the mean since the plateau began,
//   - stays above 1.15 times the greatest stress of the plateau,
//   - for at least 0.01 of strain.
// The foot is the last point before r at which sigma was at the mean of the plateau.
//
// A rise is densification if the lattice is dense at r: then r is the first strain that fulfils all of this, and the
// onset is sought from the strain on from which the lattice stays dense up to r. Walls whose fibres harden, and rows
// that have folded and fold once more, make the stress rise too, between walls that are many thicknesses apart.

/// Least solid fractions of a dense lattice: walls lie no more than eight thicknesses apart on average, and no more
/// than six and a half in the densest layer. In Example 1, whose specimens densify in experiments, they are 0.13 to
/// 0.17 and 0.17 to 0.22 at the onset.
inline constexpr double kDenseLattice = 0.125;
inline constexpr double kDenseLayer = 0.15;
/// Least contacts per wall of a dense lattice: walls that do not touch are not packed, however near they are.
inline constexpr double kDenseContacts = 0.1;
/// Fall of the stress after its greatest value, over that, by which a lattice has collapsed before.
inline constexpr double kCollapsed = 0.1;

struct CurveRise {
  double onset = 0.0;       ///< strain of the greatest eta
  bool is_dense = false;    ///< whether the lattice is dense from there on
  bool has_fallen = false;  ///< whether the stress fell by kCollapsed before the rise; not sought in a dense lattice
};

/// The rise of a curve; nothing without one: the stress stays, or the run ends too early to tell. `is_dense` says
/// whether the lattice is dense at a strain. Without a rise at which it is, the first of all.
/// `curve`: of both plates, for a crush at any speed.
std::optional<CurveRise> find_rise(const Curve& curve, const std::function<bool(double)>& is_dense);

/// The onset by the curve alone, for samples of which nothing else is known.
std::optional<double> find_onset(const Curve& curve);

/// The rise of a run, and what it is. REQUIRES: samples, and a scene with plates.
std::optional<LastingRise> find_lasting_rise(const Scene& scene, std::span<const Sample> samples);

}  // namespace cellcrush

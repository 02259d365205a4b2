#pragma once

#include <optional>
#include <span>

#include "cellcrush/sample.h"
#include "cellcrush/scene.h"

namespace cellcrush {

// Inertia's share of the work: the kinetic energy of the lattice over the work done by then. The usual bound of a
// quasi-static explicit analysis is on this ratio (Prior, J. Mater. Process. Technol. 45, 1994; Chung, Cho and
// Belytschko, Int. J. Mech. Sci. 40, 1998). In a shock of Eq. 51 with sigma = sigma_0 + D the share is D / (2 sigma),
// so twice the share is what inertia adds to the plateau.

/// Unwanted share above which the result of scaled masses is warned of, and above which a run ends. A quasi-static
/// crush is warned of above its bound, Plates::kinetic_share.
inline constexpr double kInertiaWarning = 0.02;
inline constexpr double kLargestInertia = 0.10;
/// Share that remedies aim at: cells that snap make it fall more slowly than with the square of the speed.
inline constexpr double kRemediedInertia = 0.005;

/// Range of nominal strain over which the share is taken: the plateau window, or from half of the last strain on if
/// that is less than the beginning of the window. The last strain is that of the end or of closing.
struct InertiaWindow {
  double low = 0.0;
  double high = 0.0;

  [[nodiscard]] bool holds(double strain) const { return strain >= low && strain <= high; }
};
/// REQUIRES: plates.
InertiaWindow inertia_window_of(const Scene& scene);

/// Kinetic energy over the work done by the time of a sample, or over all energy put in if that is greater; 0 before
/// there is any.
double inertia_share_of(const Sample& sample);

/// The part of the share that is due to mass that the material does not have: 0 with real masses. In a quasi-static
/// crush, whose masses are real, all of it.
double unwanted_share_of(const Scene& scene, double inertia_share);

/// The greatest share over the window; nothing without plates, or if no sample is in the window.
std::optional<double> find_inertia_share(const Scene& scene, std::span<const Sample> samples);

/// What an unwanted share means, as a clause without a full stop.
std::string words_of_inertia(const Scene& scene, double share);

/// What reduces an unwanted share.
std::string remedy_for_inertia(const Scene& scene, double share);

/// Warns of an unwanted share where it is greatest in the window.
std::optional<Warning> warn_of_inertia(const Scene& scene, std::span<const Sample> samples);

}  // namespace cellcrush

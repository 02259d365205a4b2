#pragma once

#include <optional>
#include <span>

#include "cellcrush/sample.h"
#include "cellcrush/scene.h"

namespace cellcrush {

/// Mass over that of the solid envelope.
double relative_density_of(const Scene& scene);

/// Mass of the run, with its scaling (E11b), over the envelope, tonne / mm^3. REQUIRES: plates.
double moving_density_of(const Scene& scene);

/// Closed-form solutions to compare a result with (Eq. 51, with the collapse stress as sigma_0 and densification at 1 -
/// 1.4 relative density, Gibson and Ashby; rho V^2 with the masses of the run). All 0 for a scene without plates.
Theory theory_of(const Scene& scene);

/// The front over the plateau range, and with it the shock theory with the Rankine-Hugoniot jumps (Eq. 52):
///   sigma = sigma_A + rho [V]^2 / [eps].
/// Here rho is the mass of the run over the envelope, [] the jump across the front, and sigma_A the stress just ahead
/// of it. The jumps are those of the fronts of the samples. They come from the motion of the cells, not from the stress
/// with which the theory is compared.
///
/// The stress sigma_A is that at the support plus the stress that decelerates or accelerates the material ahead. This
/// material moves nearly as one body, so that
///   sigma_A = support stress + rho (length ahead) d(velocity ahead)/dt.
/// The derivative is the least-squares slope over the range; jumps, lengths and the support stress are means over it.
/// Returns nothing unless at least half of the samples in the range have a front. `stress_support`: mean at the support
/// plate over the range, MPa.
std::optional<FrontSummary> summarize_front(const Scene& scene, std::span<const Sample> samples, double stress_support);

}  // namespace cellcrush

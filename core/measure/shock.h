#pragma once

#include <optional>
#include <span>

#include "cellcrush/sample.h"
#include "cellcrush/scene.h"

namespace cellcrush {

/// The front over the plateau window, and with it the shock theory with the Rankine-Hugoniot jumps (Eq. 52):
///   sigma = sigma_A + rho [V]^2 / [eps],
/// rho the mass over the envelope, [] the jump across the front, sigma_A the stress just ahead of it. The jumps are
/// those of the samples' fronts: of the motion of the cells, not of the stress that theory is held against. sigma_A is
/// what the support bears plus what the material ahead takes up as it is braked or pushed on: it moves nearly as one,
/// so that
///   sigma_A = support stress + rho (length ahead) d(velocity ahead)/dt,
/// the velocity's rise being its least-squares slope over the window. Jumps, lengths and the support stress are means
/// over the window. Nothing unless at least half of the window's samples have a front. `stress_support`: mean at the
/// support plate over the window, MPa.
std::optional<FrontSummary> summarize_front(const Scene& scene, std::span<const Sample> samples, double stress_support);

}  // namespace cellcrush

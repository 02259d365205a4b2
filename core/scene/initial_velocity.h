#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// Fills initial_velocity and initial_spin of the scene. Nodes have what the frame gives them; all others are at rest.
/// Inside a beam whose two nodes are both named, velocities are those of a beam element between them (E14b). V_1, V_2
/// and omega_1, omega_2 are the velocities and spins of its nodes, L its length, n its normal and s the place along it:
///   Omega    = n . (V_2 - V_1) / L
///   v(s)     = (1 - s) V_1 + s V_2 + n L [s (1 - s)^2 (omega_1 - Omega) - s^2 (1 - s) (omega_2 - Omega)]
///   omega(s) = Omega + (1 - 4 s + 3 s^2) (omega_1 - Omega) + (3 s^2 - 2 s) (omega_2 - Omega).
/// A rigid motion of its nodes is thus a rigid motion of the beam. A beam with a node that is not named is at rest
/// inside, so that a mass at its end can strike it.
/// Pinned ends turn as the chord of their beam, Omega.
/// REQUIRES: the mesh of the scene is that of the frame; its pins are grouped.
void attach_initial_velocities(const FrameWalls& frame, const std::vector<LoadsSpec::InitialVelocity>& velocities,
                               Scene& scene);

}  // namespace cellcrush

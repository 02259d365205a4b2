#pragma once

#include "cellcrush/scene.h"

namespace cellcrush {

/// Speed of a plate, mm/s, at which the kinetic energy is a given share of the work done where the plateau window
/// begins, at the strain 0.2. With V the speed, rho_r the relative density of the lattice, rho and sigma_y the density
/// and the yield stress of its walls, and b the share:
///   - The lattice bears about sigma = sigma_y rho_r^2 / 2 on its plateau. That is (2/3) sigma_y (h/L)^2 of hexagons
///     (Gibson and Ashby); stretched walls of other lattices buckle and then bear as little.
///   - Velocities fall evenly from V to 0 at the support, so that at the strain e the kinetic energy is
///     rho rho_r V^2 / (6 sigma e) of the work. At e = 0.2 that is b for V^2 = 0.6 b rho_r sigma_y / rho.
double quasi_static_speed(double share, double relative_density, const Material& material);

}  // namespace cellcrush

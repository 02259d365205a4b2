#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"
#include "scene/mesh_part.h"

namespace cellcrush {

/// Speed of a plate, mm/s, at which the kinetic energy is a given share of the work done where the plateau window
/// begins, at the strain 0.2. With V the speed, rho_r the relative density of the lattice, rho and sigma_y the density
/// and the yield stress of its walls, and b the share:
///   - The lattice bears about sigma = sigma_y rho_r^2 / 2 on its plateau. That is (2/3) sigma_y (h/L)^2 of hexagons
///     (Gibson and Ashby); stretched walls of other lattices buckle and then bear as little.
///   - Velocities fall evenly from V to 0 at the support, so that at the strain e the kinetic energy is
///     rho rho_r V^2 / (6 sigma e) of the work. At e = 0.2 that is b for V^2 = 0.6 b rho_r sigma_y / rho.
double quasi_static_speed(double share, double relative_density, const Material& material);

/// The spec of a quasi-static crush (loading.quasi_static) with its greatest speed, at which the share is
/// loading.kinetic_share; any other spec as it is. Before the plateau window the run is slower (step/plate_control.h).
/// Masses stay real: a crush at V with masses times s is that at V sqrt(s) with real ones, in the same number of steps.
SceneSpec with_chosen_speed(SceneSpec spec, const MeshMeasures& mesh);

/// Time of a quasi-static crush to a strain over that at its greatest speed throughout. With V sqrt(e / 0.2), a
/// constant share, the strain up to 0.2 takes as long as twice as much at V.
double slowing_of_quasi_static(double end_strain);

}  // namespace cellcrush

#pragma once

#include "cellcrush/scene.h"

namespace cellcrush {

/// Largest stable step of a free element of length l, thickness h and lumped masses s rho A l / 2 with rotary inertia
/// q m gamma^2 (Eq. 2, 3): of the mode in which both nodes turn the same way and the axial one,
///   dt = sqrt(s) (l / c) min(1, sqrt(q / 3) / sqrt(1 + 4 q gamma^2 / l^2)),  c = sqrt(E / rho),  gamma^2 = h^2 / 12.
/// With real masses, s = q = 1, the first governs. It bounds a lattice of such elements from below, to within 2 %.
double stable_step_of_element(double length, double thickness, const Material& material, const MassScaling& scaling);

/// The least of it over all elements of the undeformed mesh. Attached masses only raise it.
double stable_step_of(const Scene& scene);

}  // namespace cellcrush

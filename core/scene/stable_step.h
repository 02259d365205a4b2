#pragma once

#include "cellcrush/scene.h"

namespace cellcrush {

/// Largest stable step of a free element (Eq. 2, 3, E11, E11b). Its length is l, its thickness h, its lumped masses are
/// s rho A l / 2 and its rotary inertias q m gamma^2. The step is the smaller of two,
///   dt = sqrt(s) (l / c) min(1, sqrt(q / 3) / sqrt(1 + 4 q gamma^2 / l^2)),  c = sqrt(E / rho),  gamma^2 = h^2 / 12,
/// that of the axial mode and that of the mode in which both nodes turn the same way. With real masses, s = q = 1, the
/// latter governs. The step is a lower bound for a lattice of such elements, accurate to 2 %.
double stable_step_of_element(double length, double thickness, const Material& material, const MassScaling& scaling);

/// The least stable step of all elements of the undeformed mesh. Attached masses only raise it.
double stable_step_of(const Scene& scene);

}  // namespace cellcrush

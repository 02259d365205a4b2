#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"
#include "scene/mesh_part.h"

namespace cellcrush {

/// Largest stable step of a free element (Eq. 2, 3, E11, E11b). Its length is l, its thickness h, its lumped masses are
/// s rho A l / 2 and its rotary inertias q m gamma^2. The step is the smaller of two,
///   dt = sqrt(s) (l / c) min(1, sqrt(q / 3) / sqrt(1 + 4 q gamma^2 / l^2)),  c = sqrt(E / rho),  gamma^2 = h^2 / 12,
/// that of the axial mode and that of the mode in which both nodes turn the same way. With real masses, s = q = 1, the
/// latter governs. The step is a lower bound for a lattice of such elements, accurate to 2 %.
double stable_step_of_element(double length, double thickness, const Material& material, const MassScaling& scaling);

/// The least stable step of all elements of the undeformed mesh. Attached masses only raise it.
double stable_step_of(const Scene& scene);

/// Fraction of the stable step that is used.
inline constexpr double kStepFraction = 0.9;

struct TimeStep {
  double seconds = 0.0;
  StepBound bound = StepBound::asked_for;
};

/// The step of a run: the one that is given, or the least of
///  - 0.9 of the stable step of the mesh (E11b),
///  - the time in which the plate moves by a twentieth of the thinnest wall (walls approach each other by up to 1.7
///    times as much in a step, and a new contact can be as deep),
///  - 0.9 of the bound of a row of the lightest particles between contacts (E12, scene/contact_law.h),
///  - for squares and triangles, the step for which omega dt of the lightest particle on its contact is 0.11 rad. At
///    speeds V below 0.45 sqrt(sigma_y / rho) it is less in proportion, but at least a third of it.
///
/// Reason for the last: their walls lie along the crush and are stacked. Contacts between them oscillate against each
/// other and create energy, in proportion to the square of omega dt. By 45 % strain, the energy created in per cent of
/// the work of the plate, which falls with the speed, is
///   squares    25 m/s            2.0, 0.7, 0.2 at 0.29, 0.11, 0.08 rad
///   triangles  25 m/s            1.0, 0.2 at 0.11, 0.056 rad
///   triangles  50, 75, 100 m/s   0.4, 0.2, 0.1 at 0.11 rad
///   hexagons   none at 0.31 rad
TimeStep time_step_of(const SceneSpec& spec, const MeshMeasures& mesh, const ContactLaw& contact, const Plates& plates);

}  // namespace cellcrush

#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"
#include "scene/mesh_part.h"

namespace cellcrush {

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

/// Fraction of the stable step that is used.
inline constexpr double kStepFraction = 0.9;

}  // namespace cellcrush

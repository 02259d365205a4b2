#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"
#include "scene/mesh_part.h"

namespace cellcrush {

struct TimeStep {
  double seconds = 0.0;
  StepBound bound = StepBound::asked_for;
};

/// The step of a run: the one that is asked for, or the least of
///  - 0.9 of the stable step of the mesh (E11),
///  - the time in which the plate moves by a twentieth of the thinnest wall: walls approach each other by up to 1.7
///  times
///    that in a step, and a contact is born as deep,
///  - 0.9 of the bound of a row of the lightest particles between contacts (scene/contact_law.h),
///  - for squares and triangles, in which it turns the lightest particle on its contact by 0.11 rad, at speeds V under
///    0.45 sqrt(sigma_y / rho) by less in proportion, to a third of it: their walls lie along the crush and are
///    stacked, and contacts that ring among each other make energy, as the square of the turn. In per cent of the
///    plate's work, which falls with the speed, it is by 45 % strain: squares at 25 m/s 2.0, 0.7, 0.2 at 0.29, 0.11,
///    0.08 rad, triangles 1.0, 0.2 at 0.11, 0.056 rad; triangles at 50, 75, 100 m/s 0.4, 0.2, 0.1 at 0.11 rad; hexagons
///    none at 0.31.
TimeStep time_step_of(const SceneSpec& spec, const MeshMeasures& mesh, const ContactLaw& contact, const Plates& plates);

/// The share of the stable step in it.
inline constexpr double kStepFraction = 0.9;

}  // namespace cellcrush

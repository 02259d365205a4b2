#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"
#include "scene/mesh_part.h"

namespace cellcrush {

/// The contact law of a case (Eq. 43; the paper gives neither k nor c):
///   k = m_min max(stiffness_factor / dt_crit^2, (V / (0.16 h_min))^2),
/// so that a particle at plate speed sinks in by 0.16 of the thinnest wall at most. k follows from the mesh and the
/// speed, so that refining the step converges to one solution; only a given step that is too long for the second term
/// bounds it.
ContactLaw contact_law_of(const SceneSpec& spec, const MeshMeasures& mesh);

/// Largest step of a row of particles of mass m between contacts: its stiffest mode has omega = 2 sqrt(k / m) and
/// sqrt(2) times the damping ratio z of one contact. With viscous forces of velocities half a step old it is stable for
///   omega dt <= 2 (sqrt(1 + 2 z^2) - sqrt(2) z).
double contact_step_of(const ContactLaw& law, double mass);

}  // namespace cellcrush

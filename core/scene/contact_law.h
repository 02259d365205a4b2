#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"
#include "scene/mesh_part.h"

namespace cellcrush {

/// V of E9, mm/s: the speed of the plate with that of what else moves (E9a), or contact.impact_speed_m_per_s where that
/// is more.
double impact_speed_of(const SceneSpec& spec, const MeshMeasures& mesh);

/// The contact law of a case (Eq. 43, E9; the paper gives neither k nor c):
///   k = m_min max(stiffness_factor / dt_crit^2, (V / (0.16 h_min))^2).
/// A particle at the speed V then penetrates by at most 0.16 of the thinnest wall. k depends on the mesh and the speed
/// only, so refining the step converges to one solution. One exception: a given step that is too long for the second
/// term limits it.
ContactLaw contact_law_of(const SceneSpec& spec, const MeshMeasures& mesh);

/// Largest stable step of a row of particles of mass m between contacts (E12). Its stiffest mode has omega = 2 sqrt(k /
/// m) and sqrt(2) times the damping ratio z of one contact. Viscous forces use velocities that are half a step old; the
/// step is then stable for
///   omega dt <= 2 (sqrt(1 + 2 z^2) - sqrt(2) z).
double contact_step_of(const ContactLaw& law, double mass);

/// The same where N such particles touch a rigid wall of mass m_w, and a row of particles is behind each. With r =
/// N m / m_w (`share`), the wall swings against all of them in a mode that fades along the rows, by the factor r - 1
/// from particle to particle, if r > 2 (E12b):
///   omega^2 = (k / m) r^2 / (r - 1).
/// A heavier wall leaves the stiffest mode to the rows. A contact with the wall has the damping c = 2 z sqrt(k m), so
/// the mode has z omega sqrt(m / k).
double striker_step_of(const ContactLaw& law, double mass, double share);

}  // namespace cellcrush

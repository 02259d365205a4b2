#pragma once

#include <cstddef>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_sums.h"
#include "contact/contact_workspace.h"
#include "parallel/workers.h"

namespace cellcrush {

/// Evaluates the contact forces on the balls of a band from its candidates (section 4.2, Eq. 41-47, E8 to E9e). Adds
/// them to contact_force and friction_force, and their totals to the sums. REQUIRES: forces are 0 at first, as
/// clear_contact_forces leaves them; bands are evaluated in order.
///
/// A face between two bands is searched by the first of them. Pairs found there with balls of the second band are
/// passed to it in the sums, so all pairs of a ball are in one list.
///
/// The normal force on the ball is k D + c dD/dt (E8); the nodes of the segment share its reaction by the lever rule.
/// Corrections to the paper:
///  - the distance is that to a capsule, ends included (geometry/capsule.h);
///  - one force per ball and polyline: of touching segments that share a node only the deepest pushes. Neither a convex
///    joint nor the inner joints of a straight chain push twice. The elastic part is the gradient of the stored energy
///    (E8b);
///  - the side of first touch is remembered until the ball leaves or goes round an end, so that a ball pressed past the
///    mid-line is pushed back, not through;
///  - the force never pulls (Eq. 43 does while walls separate);
///  - a ball and a segment that a short path along the walls joins have a shorter reach (E8a,
/// contact/topology/wall_paths.h). Friction (Eq. 44-47, E9b) grows with the slip perpendicular to the normal, with the
/// k of the normal force, up to the friction coefficient times the normal force. A ball that slides from a segment to
/// its neighbour keeps its friction force. A contact with a segment that shares no node with the one before starts from
/// 0. Friction acts at the surfaces of the walls, not at their mid-lines as in the paper (E9d,
/// contact/touch/rubbed_surface.h). c is the fraction damping_ratio of critical damping of k with the effective mass,
/// 1/m_eff = 1/m_ball + (1-s)^2/m_1 + s^2/m_2 (E9).
///
/// Five short loops over arrays (contact/touch/contact_stages.h) find the candidates that overlap, update the touch
/// history, evaluate overlap and motion, find the active contacts, and compute the forces. All but the second and the
/// fourth use vector instructions. Forces are summed in the order of balls and segments, so the sums have the same bits
/// however pairs were found.
void evaluate_contact_forces(const Scene& scene, State& state, std::size_t band, ContactWorkspace& workspace,
                             Workers& workers, ContactSums& sums);

}  // namespace cellcrush

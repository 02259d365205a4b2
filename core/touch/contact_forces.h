#pragma once

#include <cstddef>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"
#include "touch/contact_sums.h"
#include "touch/contact_workspace.h"

namespace cellcrush {

/// Evaluates the contact forces on the balls of a band (section 4.2, Eq. 41-43) from its candidates, and adds them to
/// contact_force and friction_force, and what they come to to the sums. REQUIRES: forces begin at 0, as
/// clear_contact_forces leaves them; bands one after the other.
///
/// A face between two bands is searched by the first of them. The pairs it finds of the other's balls go through the
/// sums to the other, so that all pairs of a ball stand together, in one list.
///
/// Normal force k D + c dD/dt on the ball, shared by the segment's nodes as the foot lies between them. Corrections to
/// the paper:
///  - distance to a capsule, ends included (geometry/capsule.h);
///  - one force per ball and polyline: of touching segments that share a node only the deepest pushes, so neither a
///    convex joint nor the inner joints of a straight chain push twice. The elastic part is the gradient of the energy
///    stored;
///  - the side on which a ball first touched is remembered until it leaves or goes round an end, so that one pressed
///    past the mid-line is pushed back, not through;
///  - the force never pulls (Eq. 43 does while walls part);
///  - ball and segment that a short way along the walls joins touch at a share of that way (scene/wall_paths.h).
/// Friction (Eq. 44-47) grows with the slip across the normal, with the normal force's k, up to the friction
/// coefficient times the normal force; a ball that slides from a segment to its neighbour takes it along. A contact
/// with a segment that shares no node with the one before begins without. It acts at the walls' mid-lines: the couple
/// of R and h/2 is left out, as in the paper. c is damping_ratio of critical damping of k with the effective mass 1/m =
/// 1/m_ball + (1-s)^2/m_start + s^2/m_end.
///
/// Five short loops over arrays (touch/contact_workspace.h): candidates that overlap, what is remembered of them, how
/// they stand and move, which of them are active, the forces. All but the second and the fourth use vector
/// instructions. Forces are summed in the order of balls and segments, so that the sums have the same bits however
/// pairs were found.
void evaluate_contact_forces(const Scene& scene, State& state, std::size_t band, ContactWorkspace& workspace,
                             Workers& workers, ContactSums& sums);

}  // namespace cellcrush

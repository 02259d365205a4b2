#pragma once

#include <cstddef>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"
#include "parallel/workers.h"

namespace cellcrush {

/// Evaluates the contact forces on the balls of a band from its candidates (section 4.2, Eq. 41-47, E8 to E9e). Adds
/// them to contact_force and friction_force, and their totals to the sums. core/contact.md explains the law and its
/// deviations from the source. REQUIRES: forces are 0 at first, as clear_contact_forces leaves them; bands are
/// evaluated in order.
///
/// A face between two bands is searched by the first of them. Pairs found there with balls of the second band are
/// passed to it in the sums, so all pairs of a ball are in one list.
///
/// Five short loops over arrays (contact/touch/contact_stages.h) find the candidates that overlap, update the touch
/// history, evaluate overlap and motion, find the active contacts, and compute the forces. Forces are summed in the
/// order of balls and segments, so the sums have the same bits however pairs were found.
void evaluate_contact_forces(const Scene& scene, State& state, std::size_t band, ContactWorkspace& workspace,
                             Workers& workers, ContactSums& sums);

}  // namespace cellcrush

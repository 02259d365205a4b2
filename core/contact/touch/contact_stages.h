#pragma once

#include <cstddef>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"
#include "parallel/workers.h"

// The stages of evaluate_contact_forces, in their order; each is in the source of its name.

namespace cellcrush {

/// Overwrites ContactWorkspace::found by the indices of the candidates that have begun to overlap.
///
/// A candidate that touches is not tested: its pair is evaluated in every step. In a search by faces, a candidate that
/// does not touch sleeps until its group has travelled so far that its gap can have closed (E8c,
/// contact/search/pair_search.h). In a search by buckets, all candidates that do not touch are tested.
void find_overlaps(const Scene& scene, const State& state, ContactLists& lists, ContactWorkspace& workspace,
                   Workers& workers);

/// A part of it: writes the indices of the awake candidates from `first` to `end`, which bound whole batches. Returns
/// how many there are. REQUIRES: `awake` has room for all of them and kCandidateBatch more, which are overwritten.
std::size_t find_awake_candidates(const ContactLists& lists, std::size_t first, std::size_t end, int* awake);

/// Removes the released pairs from ContactLists::touching of a band, and adds those found to overlap in the faces of
/// the band or of the band before. `of_next_band` then holds the found pairs of the next band. The earlier touches go
/// to ContactWorkspace::before; Touches::known has their indices there.
///
/// Nearly all pairs touch for many steps. They are copied in long runs between the few that are added or removed.
void remember_touches(const Scene& scene, const State& state, const LatticeBand& band, ContactLists& lists,
                      ContactWorkspace& workspace, std::vector<NewContact>& of_next_band);

/// Overwrites TouchMemory::linked of the pairs of a ball. `index`: see pairs_of_ball.
void link_pairs_of_ball(const Scene& scene, TouchMemory& touching, int ball, int index);

/// Overwrites the geometry of the pairs from `first` to `end` of ContactLists::touching (Eq. 41-42, E8,
/// contact/touch/force_laws.h), their unlimited viscous force (Eq. 43, E9) and the slip of their mid-lines. Updates the
/// sides: a new pair, or a ball beyond an end of its segment, gets the side on which it is. Overwrites `released` by
/// the pairs that no longer touch.
void evaluate_touches(const Scene& scene, const State& state, ContactLists& lists, Touches& touches, std::size_t first,
                      std::size_t end, std::vector<int>& released);

/// Bend of a segment, rad: half of what its start has turned more than its end since the start (E8e).
inline double bend_of(const State& state, const Element& segment) {
  return 0.5 * (state.rotation[segment.start] - state.rotation[segment.end]);
}

/// Overwrites the deflections of the segments of the pairs from `first` to `end`, and adds them to the depths (E8e).
/// REQUIRES: ContactLaw::bends.
void bend_segments(const Scene& scene, const State& state, const TouchMemory& touching, Touches& touches,
                   std::size_t first, std::size_t end);

/// Overwrites `active` by the touches from `first` to `end` that exert forces, by ball, segments ascending. Of touching
/// segments that share a node, only the deepest does (E8b). REQUIRES: the range has all touches of its balls.
void find_active_contacts(const Scene& scene, const State& state, const ContactLists& lists, const Touches& touches,
                          std::size_t first, std::size_t end, std::vector<ActiveContact>& active);

/// Adds the normal forces of the active contacts to contact_force and their stored energy to the totals (Eq. 43, E8,
/// E8b). Keeps each normal force for friction.
void apply_normal_forces(const Scene& scene, State& state, const TouchMemory& touching, ContactWorkspace& workspace,
                         ContactTotals& totals);

/// Adds the moments and forces by which the energy of the active contacts depends on the deflections of their segments
/// to contact_moment and contact_force (E8e). REQUIRES: ContactLaw::bends.
void apply_bending_forces(const Scene& scene, State& state, const TouchMemory& touching,
                          const ContactWorkspace& workspace);

/// Overwrites the friction of all touches by that of the active contacts (Eq. 44-47, E9b, E9d), and adds the forces
/// and couples to friction_force. REQUIRES: ContactWorkspace::active has the normal forces of this step.
void apply_friction(const Scene& scene, State& state, TouchMemory& touching, const ContactWorkspace& workspace);

}  // namespace cellcrush

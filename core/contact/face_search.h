#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"

namespace cellcrush {

/// The search by faces: a ball is held against the segments of its faces only (contact/contact_faces.h says why that is
/// enough), and a face is looked at only when a gap in it can have closed.
///
/// The bound is rigorous. A gap between a ball and a segment closes by no more than two particles of the face come nearer to
/// each other, and in a step of dt no two particles of a group of faces do so by more than `dt |v_high - v_low|`, the
/// diagonal of the box that holds the group's velocities. The sum of that is the group's travel. Each face has a budget: the
/// least gap, beyond touch, of the pairs that are not in its list, and is let be while the group has not travelled that far.
/// Then it is looked at: the diagonal of the box that holds its particles' displacements since its list was made is what its
/// gaps have closed by at most. What is left of the budget is granted; if too little is left, the list is made anew. A face
/// whose gaps are all wider than the skin has no candidates.
///
/// Searches a band's faces. Returns false when a look finds that walls have crossed: then the
/// faces are no longer those of the drawing, and what has not been looked at stays as it is.
bool search_faces(const Scene& scene, const State& state, const LatticeBand& band, const FacesOfBand& faces,
                  ContactLists& lists, Workers& workers);

}  // namespace cellcrush

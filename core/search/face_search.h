#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"

namespace cellcrush {

/// The search by faces: a ball is held against the segments of its faces only (scene/contact_faces.h says why that is
/// enough), and a face is checked only when a gap in it can have closed.
///
/// The bound is rigorous. A gap between a ball and a segment closes by no more than two particles of the face approach
/// each other. In a step of dt no two particles of a group of faces do so by more than `dt |v_high - v_low|`, the
/// diagonal of the box round the group's velocities. The sum of that is the group's travel. The clearance of a face is
/// the least gap, beyond touch, of the pairs that are not in its list. While the group has not travelled that far, the
/// face is left alone. Then it is rechecked: its gaps have closed by at most the diagonal of the box round its
/// particles' displacements since its list was made. The next check is set by the rest of the clearance; if too little
/// is left, the list is rebuilt. A face whose gaps are all wider than the skin has no candidates.
///
/// Searches a band's faces. Returns false when a recheck finds that walls have crossed. Then the faces are no longer
/// those of the drawing, and faces not yet rechecked stay as they are.
bool search_faces(const Scene& scene, const State& state, const LatticeBand& band, const FacesOfBand& faces,
                  ContactLists& lists, Workers& workers);

}  // namespace cellcrush

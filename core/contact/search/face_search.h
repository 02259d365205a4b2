#pragma once

#include <cstddef>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"

namespace cellcrush {

/// The search by faces: a ball is tested against the segments of its own faces only; contact/topology/contact_faces.h
/// explains why this is enough. A face is rechecked only when one of its gaps can have closed.
///
/// The bound is rigorous (E8c). A gap between a ball and a segment closes by no more than two particles of the face
/// approach each other. In a step of dt no two particles of a group of faces approach by more than `dt |v_high -
/// v_low|`, with the diagonal of the bounding box of the velocities of the group. The sum of this over the steps is the
/// travel of the group.
///
/// The clearance of a face is the least gap, beyond touch, of its pairs that are not in its list. The face is rechecked
/// when its group has travelled that far. Its gaps have then closed by at most the diagonal of the bounding box of the
/// displacements of its particles since its list was made. The remaining clearance sets the next check; if it is too
/// small, the list is rebuilt. A face whose gaps are all wider than the skin has no candidates.
///
/// Squashed walls grow thicker, so gaps also close at rest (E5f). What reaches can have grown by in a step is added to
/// the travel of all groups of the band.
///
/// Searches the faces of a band. Returns false if a recheck finds that walls have crossed. The faces are then no longer
/// those of the undeformed lattice, and faces that have not been rechecked stay as they are.
bool search_faces(const Scene& scene, const State& state, std::size_t band, ContactLists& lists, Workers& workers);

}  // namespace cellcrush

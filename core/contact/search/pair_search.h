#pragma once

#include <cstddef>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"

namespace cellcrush {

/// The search by faces: a ball is tested against the segments of its own faces only. A face is rechecked only when one
/// of its gaps can have closed. The bound is rigorous (E8c, core/contact.md): the travel of a group of faces is the sum
/// of `dt |v_high - v_low|` over the steps, plus what reaches can have grown by (E5f). A face is rechecked when its
/// group has travelled by the clearance of the face, the least gap beyond touch of its pairs that are not in its list.
///
/// Searches the faces of a band. Returns false if a recheck finds that walls have crossed. The faces are then no longer
/// those of the undeformed lattice, and faces that have not been rechecked stay as they are.
bool search_faces(const Scene& scene, const State& state, std::size_t band, ContactLists& lists, Workers& workers);

/// The search in space (section 4.1), which works for any lattice: all pairs within touch plus skin, found over a grid
/// of buckets. Rebuilds the list when some particle has moved by half of the skin since the last search, less what
/// walls have grown thicker (E5f). It is the reference for the search by faces. Returns false if it rebuilds the list
/// and finds that walls have crossed. Requires a call in every step.
bool search_buckets(const Scene& scene, const State& state, ContactLists& lists);

/// Rebuilds the list now, in the order of the segments. Returns false if walls have crossed: an end that has gone
/// through a segment is listed beside it. REQUIRES: finite positions.
bool list_by_buckets(const Scene& scene, const State& state, ContactLists& lists);

}  // namespace cellcrush

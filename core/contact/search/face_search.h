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

}  // namespace cellcrush

#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"
#include "touch/contact_workspace.h"

namespace cellcrush {

/// Overwrites ContactWorkspace::found by the indices of the candidates that have begun to overlap.
///
/// A candidate that touches is not tested: its pair is evaluated in every step. In a search by faces, a candidate that
/// does not touch sleeps until its group has travelled so far that its gap can have closed (E8c, search/face_search.h).
/// In a search by buckets, all candidates that do not touch are tested.
void find_overlaps(const Scene& scene, const State& state, ContactLists& lists, ContactWorkspace& workspace,
                   Workers& workers);

}  // namespace cellcrush

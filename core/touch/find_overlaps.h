#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"
#include "touch/contact_workspace.h"

namespace cellcrush {

/// Overwrites ContactWorkspace::found by the places of the candidates that have begun to overlap.
///
/// A candidate that touches is not tested: its pair is evaluated in every step. Where contacts are searched by faces,
/// one that does not touch sleeps until its gap can have closed, until its group has travelled that far
/// (search/face_search.h). By buckets all the others are tested.
void find_overlaps(const Scene& scene, const State& state, ContactLists& lists, ContactWorkspace& workspace,
                   Workers& workers);

}  // namespace cellcrush

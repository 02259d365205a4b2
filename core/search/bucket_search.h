#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// The search in space (section 4.1), which asks nothing of the lattice: all pairs within touch and skin, found over a
/// grid of buckets. Makes the list when the one at hand no longer holds: until some particle has moved by half of the
/// skin. It is the reference for the search by faces.
void search_buckets(const Scene& scene, const State& state, ContactLists& lists);

/// Makes the list now, in the order of the segments. REQUIRES: finite positions.
void list_by_buckets(const Scene& scene, const State& state, ContactLists& lists);

}  // namespace cellcrush

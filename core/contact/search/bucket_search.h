#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// The search in space (section 4.1), which works for any lattice: all pairs within touch plus skin, found over a grid
/// of buckets. Rebuilds the list when some particle has moved by half of the skin since the last search, less what
/// walls have grown thicker (E5f). It is the reference for the search by faces. Returns false if it rebuilds the list
/// and finds that walls have crossed. Requires a call in every step.
bool search_buckets(const Scene& scene, const State& state, ContactLists& lists);

/// Rebuilds the list now, in the order of the segments. Returns false if walls have crossed: an end that has gone
/// through a segment is listed beside it. REQUIRES: finite positions.
bool list_by_buckets(const Scene& scene, const State& state, ContactLists& lists);

}  // namespace cellcrush

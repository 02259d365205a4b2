#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Makes the list of balls and segments that may touch (section 4.1), when the one at hand no longer holds: it was made with
/// a skin beyond touch, and holds until some particle has moved by half of it. Candidates carry over what they remember.
///
/// A ball stands at every particle; it is never held against the elements that end at it.
/// After a non-finite position the list is left as it is; the run is stopped by its check of the state.
void find_contacts(const Scene& scene, State& state);

/// Makes the list now.
void search_contacts(const Scene& scene, State& state);

}  // namespace cellcrush

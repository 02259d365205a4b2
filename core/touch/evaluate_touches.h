#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "touch/contact_workspace.h"

namespace cellcrush {

/// Overwrites the geometry of the pairs from `first` to `end` of ContactLists::touching (Eq. 41-42, E8,
/// geometry/capsule.h), their unlimited viscous force (Eq. 43, E9) and their slip. Updates the sides: a new pair, or a
/// ball beyond an end of its segment, gets the side on which it is. Overwrites `released` by the pairs that no longer
/// touch.
void evaluate_touches(const Scene& scene, const State& state, ContactLists& lists, Touches& touches, std::size_t first,
                      std::size_t end, std::vector<int>& released);

}  // namespace cellcrush

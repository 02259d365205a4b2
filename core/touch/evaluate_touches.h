#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "touch/contact_workspace.h"

namespace cellcrush {

/// Overwrites how the pairs from `first` to `end` of ContactLists::touching stand to each other (geometry/capsule.h),
/// their free viscous force and their slip, and keeps the sides up to date: a pair that is new, and a ball beyond an
/// end of its segment, is on the side where it stands. Overwrites `released` by those that touch no more.
void evaluate_touches(const Scene& scene, const State& state, ContactLists& lists, Touches& touches, std::size_t first,
                      std::size_t end, std::vector<int>& released);

}  // namespace cellcrush

#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "touch/contact_workspace.h"

namespace cellcrush {

/// Overwrites `active` by the touches from `first` to `end` that exert forces, by ball, segments ascending. Of touching
/// segments that share a node, only the deepest does (E8b). REQUIRES: the range has all touches of its balls.
void find_active_contacts(const Scene& scene, const State& state, const ContactLists& lists, const Touches& touches,
                          std::size_t first, std::size_t end, std::vector<ActiveContact>& active);

}  // namespace cellcrush

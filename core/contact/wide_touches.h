#pragma once

#include <cstddef>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"

namespace cellcrush {

/// evaluate_touches with the processor's vector instructions, a pair a lane, of the pairs from `first` to `end`. Writes those
/// that have parted to `parted`, ascending, and returns how many there are. REQUIRES: room for all of them there.
std::size_t evaluate_touches_wide(const Scene& scene, const State& state, ContactLists& lists, Touches& touches,
                                  std::size_t first, std::size_t end, int* parted);

}  // namespace cellcrush

#pragma once

#include "cellcrush/state.h"

namespace cellcrush {

/// Gives up the search by faces: the pairs that touch go into the first list, in their order; there are no candidates.
void put_into_one_list(State& state);

}  // namespace cellcrush

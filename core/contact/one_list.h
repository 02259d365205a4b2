#pragma once

#include "cellcrush/state.h"

namespace cellcrush {

/// Gives up the search by faces: the pairs that touch go into one list, in their order, and there are no candidates.
void put_into_one_list(State& state);

}  // namespace cellcrush

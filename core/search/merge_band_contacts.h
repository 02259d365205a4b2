#pragma once

#include "cellcrush/state.h"

namespace cellcrush {

/// Ends the search by faces: the touching pairs of all bands go into the first list, in order; no candidates are left.
void merge_band_contacts(State& state);

}  // namespace cellcrush

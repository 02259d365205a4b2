#pragma once

#include "cellcrush/state.h"

namespace cellcrush {

/// Ends the search by faces: merges the touching pairs of all bands, in order, into the first list, and removes all
/// candidates.
void merge_band_contacts(State& state);

}  // namespace cellcrush

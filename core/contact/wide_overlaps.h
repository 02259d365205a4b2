#pragma once

#include <cstddef>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"

namespace cellcrush {

// The loops of find_overlaps with the processor's vector instructions.

/// Writes the places from `first` to `end`, whole batches, of the candidates that are awake; returns how many there are.
/// REQUIRES: room for all of them.
std::size_t find_awake_wide(const State& state, std::size_t first, std::size_t end, int* places);

/// Overwrites the alarms of those that are awake: infinite of those that overlap.
void test_awake_wide(const Scene& scene, const State& state, AwakeCandidates& awake);

}  // namespace cellcrush

#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

// The loops of find_overlaps with the processor's vector instructions.

/// Writes the places from `first` to `end`, whole batches, of the candidates that are awake; returns how many there are.
/// REQUIRES: room for all of them and kCandidateBatch more, which are overwritten.
std::size_t find_awake_wide(const ContactLists& lists, std::size_t first, std::size_t end, int* places);

/// Sets the alarms of the candidates at these places, and adds those that overlap to `found`; their alarms are infinite.
void test_awake_wide(const Scene& scene, const State& state, ContactLists& lists, std::span<const int> places,
                     std::vector<int>& found);

}  // namespace cellcrush

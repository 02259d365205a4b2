#pragma once

#include <cstdint>

#include "cellcrush/scene.h"
#include "cellcrush/stage.h"
#include "cellcrush/state.h"
#include "step/workspace.h"

namespace cellcrush {

/// Whether steps of a lattice that is cut into bands can be advanced block by block: while contacts are searched
/// by faces.
bool can_advance_blocks(const Scene& scene, const State& state);

/// Of some steps, those to advance in a block first.
std::int64_t steps_in_block(std::int64_t steps);

/// Advances the state by some steps at once, to the same bits as one after the other.
///
/// A large lattice waits for memory where every stage passes over all of it. Here a band does its step (motion, walls,
/// and the contacts of the band before), and the band some places before it does the next one while it is in the caches
/// (parallel/wavefront.h), as a band has to do with its neighbours only (scene/bands.h). The bands at work are so far
/// apart that threads do them side by side. Forces on a particle are added in the order of bands, whoever does what
/// when, and what is summed over the lattice is written down by chunk and step and summed afterwards.
///
/// Walls found to have crossed are reported when the block is done. REQUIRES: can_advance_blocks.
void advance_block(const Scene& scene, State& state, Workspace& workspace, std::int64_t steps, StageObserver* observer);

}  // namespace cellcrush

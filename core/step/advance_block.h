#pragma once

#include <cstdint>

#include "cellcrush/scene.h"
#include "cellcrush/stage.h"
#include "cellcrush/state.h"
#include "step/workspace.h"

namespace cellcrush {

/// Whether steps of a lattice that is cut into bands can be advanced block by block: with vector kernels, while contacts are
/// searched by faces.
bool can_advance_blocks(const Scene& scene, const State& state);

/// Of some steps, those that are worth to be advanced together first: so many that what is at work stays in the caches.
std::int64_t steps_in_block(const Scene& scene, const Workspace& workspace, std::int64_t steps);

/// Advances the state by some steps at once, to the same bits as one after the other.
///
/// A large lattice waits for memory where every stage passes over all of it. Here a band does its step (motion, walls, and the
/// contacts of the band before) and then the band some places before it does the next one, while it is in the caches:
///
///     step n      band 0   1   2   3   4   5 ...
///     step n + 1             0   1   2   3 ...
///     step n + 2                   0   1 ...
///
/// as a band has to do with its neighbours only (scene/bands.h). In each column the bands are so far apart that threads do them
/// side by side. Forces on a particle are added in the order of bands whatever the columns, and what is summed over the
/// lattice is written down by chunk and step and summed afterwards.
///
/// Walls found to have crossed are told when the block is done. REQUIRES: can_advance_blocks.
void advance_block(const Scene& scene, State& state, Workspace& workspace, std::int64_t steps, StageObserver* observer);

}  // namespace cellcrush

#pragma once

#include <cstdint>

#include "cellcrush/scene.h"
#include "cellcrush/stage.h"
#include "cellcrush/state.h"
#include "step/workspace.h"

namespace cellcrush {

/// Whether steps of a lattice that is cut into bands can be advanced in wavefronts: only while contacts are searched
/// by faces.
bool can_advance_wavefronts(const Scene& scene, const State& state);

/// How many of some steps to advance in one wavefront; 0 if the next one is to be advanced alone. Ends the search by
/// faces where parts of the border that bands search separately come so near each other that they may touch soon.
std::int64_t begin_wavefront(const Scene& scene, State& state, std::int64_t steps);

/// Advances the state by some steps at once, to the same bits as one after the other.
///
/// If every stage passes over the whole of a large lattice, the steps wait for memory. Here a band does its step
/// (motion, walls, and the contacts of the band before). While its data is in the caches, the next step follows some
/// bands behind (parallel/workers.h). This is possible because a band interacts with its neighbours only
/// (contact/topology/bands.h). Bands in progress are far enough apart for threads to do them side by side. Forces on a
/// particle are added in the order of bands, whichever thread computes them. Sums over the lattice are recorded by
/// chunk and step and added afterwards.
///
/// Walls found to have crossed are reported at the end of the wavefront. REQUIRES: so many steps of begin_wavefront.
void advance_wavefront(const Scene& scene, State& state, Workspace& workspace, std::int64_t steps,
                       StageObserver* observer);

}  // namespace cellcrush

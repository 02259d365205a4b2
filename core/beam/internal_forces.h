#pragma once

#include <cstddef>

#include "beam/walls_workspace.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"

namespace cellcrush {

/// Axes, lengths, fibre histories and internal forces of a band's elements from the particles' motion over the last
/// step (Eq. 7-32), chunk by chunk, and the sums on the joints that have no walls in later bands. Overwrites the
/// plastic work of each of the band's chunks, N mm. REQUIRES: the bands before have been evaluated.
void evaluate_internal_forces(const Scene& scene, State& state, const LatticeBand& band, WallsWorkspace& workspace,
                              Workers& workers, double* plastic_work);

// The same of the whole lattice in three stages, for two threads: contacts need the new axes and lengths, but no
// stresses, so they overlap with the second stage.

/// Axes, lengths and increments of strain of all elements.
void deform_walls(const Scene& scene, State& state, WallsWorkspace& workspace, Workers& workers);

/// Pieces of respond_walls.
std::size_t wall_piece_count(const Scene& scene);

/// Fibre histories and forces of a piece of the walls. Any thread may take any piece. REQUIRES: deform_walls.
void respond_walls(const Scene& scene, State& state, WallsWorkspace& workspace, std::size_t piece,
                   double* plastic_work);

}  // namespace cellcrush

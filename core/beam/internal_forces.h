#pragma once

#include <cstddef>

#include "beam/walls_workspace.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"

namespace cellcrush {

/// Makes room for State::thickening_step, if squashed walls grow thicker. REQUIRED before the functions below.
void size_thickening_step(const Scene& scene, State& state);

/// Evaluates axes, lengths, fibre histories and internal forces of the elements of a band, chunk by chunk (Eq. 7-32, E3
/// to E7). They follow from the motion of the particles over the last step. Sums the forces on the joints that have no
/// walls in later bands. Overwrites the plastic work of each chunk of the band, N mm. REQUIRES: earlier bands have been
/// evaluated.
void evaluate_internal_forces(const Scene& scene, State& state, const LatticeBand& band, WallsWorkspace& workspace,
                              Workers& workers, double* plastic_work);

// The same for the whole lattice in three stages, for two threads. Contacts need the new axes and lengths but no
// stresses, so their evaluation overlaps with the second stage.

/// Axes, lengths and strain increments of all elements (E3 to E5).
void deform_walls(const Scene& scene, State& state, WallsWorkspace& workspace, Workers& workers);

/// Number of pieces of respond_walls.
std::size_t wall_piece_count(const Scene& scene);

/// Fibre histories and forces of one piece of the walls (E6, E7). Any thread may compute any piece. REQUIRES:
/// deform_walls has been called.
void respond_walls(const Scene& scene, State& state, WallsWorkspace& workspace, std::size_t piece,
                   double* plastic_work);

}  // namespace cellcrush

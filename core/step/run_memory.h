#pragma once

#include <cstdint>

#include "cellcrush/scene.h"
#include "scene/array_counts.h"

namespace cellcrush {

// The memory of a run, predicted: the bytes that become resident from before the scene is built until the crush ends.
//
// Counted: every array, by the number of entries that its shape states (cellcrush/array_shape.h). The lists of arrays
// are those that checkpoint, hash and large pages go by.
//   - Scene and state.
//   - Candidates and touches, whose number grows with the strain as Growth says. In a lattice of one band their lists
//     are long: each time one grows it moves, and the heap keeps what it leaves behind. Lists of bands are short and
//     reuse what others leave.
//   - The workspace of the contacts, for one band at a time, and the records of the steps in a wavefront.
//   - Cells and columns, by which samples are measured; the frame that is kept in case the run fails; a frame and a
//     field of collapsed cells while they are made.
//   - kOfRun, which does not depend on the lattice.
// Not counted: the program, its libraries and threads; what building the scene needs for a while, which is less than
// the run needs; samples and frames that a caller keeps; copies of the state while a checkpoint is written; scratch of
// a second thread; buckets while a search sorts.
//
// tests/core/memory/run_memory_test.cpp holds the prediction against resident bytes.

/// Entries for each element and unit of strain, with the room that lists have. Measured at 80 % strain in Type I, the
/// squares and the triangles at 300 m/s, 30 to 74 cells long, by both section rules: candidates by faces 4.2 to 7.1, by
/// buckets 7.9; touches 0.66 to 0.96.
struct Growth {
  double candidates_by_faces = 5.0;
  double candidates_by_buckets = 8.0;
  double touches = 0.85;
};
inline constexpr Growth kGrowth;

/// Bytes that the heap holds over bytes that growing lists use, where there is but one band. Measured in the same
/// crushes: by faces 1.3 to 1.7, by buckets, where lists are made at once, 1.23.
inline constexpr double kHeldByFaces = 1.5;
inline constexpr double kHeldByBuckets = 1.25;

/// Bytes of a run of any size: code that only a large crush runs, the heap's reserve. Measured: 0.2 to 0.7 MB.
inline constexpr double kOfRun = 400'000.0;

/// Bytes of a run of a scene with so many entries in its arrays that is crushed to a strain; candidates and touches are
/// added here.
std::int64_t memory_of_run(ArrayCounts counts, double end_strain);

/// Of a scene.
std::int64_t memory_of_run(const Scene& scene);

/// Strain at the end of a schedule; 1 without plates, as nobody says how near the walls come.
double end_strain_of(const Plates& plates, const Schedule& schedule, double length);

}  // namespace cellcrush

#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "cellcrush/vector.h"
#include "parallel/workers.h"

namespace cellcrush {

/// Values per element that are passed between the loops over geometry, fibres and forces.
inline constexpr std::size_t kScratchKinds = 4;

/// Scratch in either precision of the fibres.
struct WallScratch {
  LaneVector<float> in_single;
  LaneVector<double> in_double;

  template <class T>
  LaneVector<T>& of() {
    if constexpr (std::is_same_v<T, float>) {
      return in_single;
    } else {
      return in_double;
    }
  }
};

/// Scratch for the walls, kept from step to step so that no step allocates. No result depends on its contents.
struct WallsWorkspace {
  std::vector<WallScratch> of_thread;  ///< one chunk at a time

  // For steps that deform all chunks before any of them responds.
  WallScratch all;  ///< kScratchKinds E
  /// C chunks, 1 if any of the elements is squashed, so that its modulus is reduced.
  std::vector<std::uint8_t> squashed;
};

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

/// Sums the forces of walls on joints `first` to `end` (E7), for each joint in a fixed order. The sums therefore have
/// the same bits for any thread. Does nothing if first >= end.
void sum_joint_forces(const Scene& scene, State& state, std::size_t first, std::size_t end);

/// The same for all joints.
void sum_joint_forces(const Scene& scene, State& state, Workers& workers);

}  // namespace cellcrush

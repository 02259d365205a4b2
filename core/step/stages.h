#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/stage.h"
#include "cellcrush/state.h"
#include "step/step_record.h"
#include "step/workspace.h"

namespace cellcrush {

/// A step in progress: what the stages read and write.
struct StepInProgress {
  const Scene& scene;
  State& state;
  StepRecord& record;
  StageWorkspace& workspace;
  std::vector<int>& near_plates;  ///< see NearCounts
};

/// Parts of a state that stages hand to each other. A set of them is a sum.
enum Data : unsigned {
  kMotion = 1,          ///< positions and velocities, of plates and rigid bodies too
  kGeometry = 2,        ///< axes, lengths and thickening of elements
  kStresses = 4,        ///< histories of fibres and sections
  kInternalForces = 8,  ///< of walls on particles
  kContactLists = 16,   ///< pairs that may touch, and those that do
  kContactForces = 32,  ///< of contacts, plates and rigid walls
  kLoads = 64,
};

/// A stage in two parts, so that other stages can run beside the second one.
struct SplitStage {
  void (*begin)(StepInProgress& step);
  std::size_t (*piece_count)(const Scene& scene);
  /// Beside other stages; any thread may take any piece.
  void (*piece)(StepInProgress& step, std::size_t piece);
  void (*end)(StepInProgress& step);
  unsigned reads;   ///< of the pieces
  unsigned writes;  ///< of the pieces and the end
};

/// A stage of a step, on the whole lattice or on one band of it (contact/topology/bands.h).
struct StageEntry {
  Stage stage;
  unsigned reads;
  unsigned writes;
  /// In a wavefront, by how many bands it follows the first stage: its forces reach into the next band.
  std::size_t bands_behind = 0;
  /// REQUIRES: earlier bands have been done. Null: only on the whole; such a lattice is not cut into bands, or the
  /// stage does nothing on it.
  void (*on_band)(StepInProgress& step, std::size_t band) = nullptr;
  void (*on_whole)(StepInProgress& step) = nullptr;  ///< null: band by band
  const SplitStage* split = nullptr;
};

/// The step: every stage, in order. The only place where this order stands; execute_stages (plain or overlapped) and
/// advance_wavefront run the list.
extern const std::array<StageEntry, kStageCount> kStages;

/// Whether a stage may run beside the pieces of a split one.
constexpr bool runs_beside(const StageEntry& entry, const SplitStage& split) {
  return (entry.reads & split.writes) == 0 && (entry.writes & (split.reads | split.writes)) == 0;
}

/// Records the step in which particles of a frame could approach each other by the most, by E8c for all of them:
/// dt |v_high - v_low|. Does nothing where contacts are not watched (ContactLaw::most_travel).
void watch_approach(const Scene& scene, State& state);

}  // namespace cellcrush

#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "push/push.h"

namespace cellcrush {

/// Record of one step: the data known before it, and the sums over the lattice that its stages compute.
struct StepRecord {
  double time = 0.0;  ///< s, at its start
  PlateStep plates;

  MotionWorks of_rigid_bodies;
  std::vector<MovedChunk> moved;     ///< of all free particles
  std::vector<NearCounts> near;      ///< of each band, particles that may be near a plate
  std::vector<double> plastic_work;  ///< N mm, of each chunk of walls
  ContactSums contacts;
  bool has_crossed = false;  ///< whether walls have crossed
};

/// Prepares the record of a step that begins at `time`, s, when the impact plate has travelled by `travel`, mm.
void begin_record(const Scene& scene, const State& state, double time, double travel, StepRecord& record);

/// Adds the works of a step to the ledger (E10) and its impulses to those of plates and rigid walls. Stores their
/// forces and the contact totals in the state.
void accumulate(const Scene& scene, const StepRecord& record, State& state);

}  // namespace cellcrush

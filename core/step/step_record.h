#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "motion/integrate_motion.h"
#include "motion/plate_motion.h"
#include "touch/contact_sums.h"
#include "touch/plate_forces.h"

namespace cellcrush {

/// Of one step: what is known before it, and the sums over the lattice that its stages leave behind.
struct StepRecord {
  PlateStep plates;   ///< what the impact plate does over the step
  PlateMotion plate;  ///< how it stands and moves at the step's end
  PlateReach reach;   ///< then

  MotionWorks of_rigid_bodies;
  std::vector<MovedChunk> moved;     ///< of all free particles
  std::vector<NearCounts> near;      ///< of each band, particles that may be near a plate
  std::vector<double> plastic_work;  ///< N mm, of each chunk of walls
  ContactSums contacts;
  bool has_crossed = false;  ///< walls
};

/// Prepares the record of a step from `time`, s, on, before which the impact plate has travelled so far, mm.
void begin_record(const Scene& scene, const State& state, double time, double travel, StepRecord& record);

/// Adds what a step's forces did to the ledger and the plates' impulses, and puts the plates' forces and the contacts'
/// totals into the state.
void accumulate(const Scene& scene, const StepRecord& record, State& state);

}  // namespace cellcrush

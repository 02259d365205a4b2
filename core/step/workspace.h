#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "beam/walls_workspace.h"
#include "contact/contact_sums.h"
#include "contact/contact_workspace.h"
#include "contact/plate_forces.h"
#include "parallel/workers.h"
#include "step/integrate_motion.h"
#include "step/wide_motion.h"

namespace cellcrush {

/// How many particles of a band may be near a plate. They stand in MotionWorkspace::near_plates from the band's first joint on,
/// and from its first particle inside a wall.
struct NearCounts {
  std::size_t joints = 0;
  std::size_t inner = 0;
};

/// Of a step of a block, what is known before it and what is summed over the lattice.
struct BlockStep {
  PlateStep plates;
  PlateMotion plate;
  PlateReach reach;
  std::vector<MovedChunk> moved;     ///< as in MotionWorkspace
  std::vector<double> plastic_work;  ///< as in WallsWorkspace
  std::vector<NearCounts> near;      ///< of each band
  ContactSums sums;
  bool has_crossed = false;  ///< walls
};

/// What a thread advances bands with.
struct WorkspacePart {
  Workers alone = Workers(1);
  WallsWorkspace walls;
  ContactWorkspace contact;
};

/// Threads and room that the stages of a step work with, kept from step to step so that no step starts or allocates. It belongs to no state: any step
/// of any state of the scene may use it, and none depends on what it holds.
struct Workspace {
  explicit Workspace(int threads = 1) : workers(threads) {}

  /// Room for so many steps of a block.
  void prepare_block(std::size_t particles, std::size_t steps) {
    block.resize(steps);
    motion.near_plates.resize(particles);
    while (parts.size() < static_cast<std::size_t>(workers.count())) {
      parts.emplace_back();
    }
  }

  Workers workers;
  MotionWorkspace motion;
  WallsWorkspace walls;
  ContactWorkspace contact;

  // Where a block of steps is advanced.
  std::vector<BlockStep> block;
  std::deque<WorkspacePart> parts;  ///< one a thread
};

}  // namespace cellcrush

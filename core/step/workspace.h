#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "beam/walls_workspace.h"
#include "cellcrush/scene.h"
#include "parallel/workers.h"
#include "step/step_record.h"
#include "touch/contact_workspace.h"

namespace cellcrush {

/// What a stage computes with: threads that share its loops, and room.
struct StageWorkspace {
  explicit StageWorkspace(int threads = 1) : workers(threads) {}

  Workers workers;
  WallsWorkspace walls;
  ContactWorkspace contact;
};

/// Threads and room for steps, kept from step to step so that no step starts or allocates any. It belongs to no state:
/// any step of any state of the scene may use it, and no result depends on what it holds.
struct Workspace {
  explicit Workspace(int threads = 1) : shared(threads) {}

  StageWorkspace shared;             ///< whose threads share the loops of a stage
  std::deque<StageWorkspace> bands;  ///< one a thread, where threads advance bands side by side
  std::vector<StepRecord> records;   ///< of the steps under way
  std::vector<int> near_plates;      ///< room for all particles; see NearCounts
};

}  // namespace cellcrush

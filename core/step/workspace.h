#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "beam/internal_forces.h"
#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"
#include "parallel/workers.h"
#include "step/step_record.h"

namespace cellcrush {

/// Threads that share the loops of a stage, and its scratch.
struct StageWorkspace {
  explicit StageWorkspace(int threads = 1) : workers(threads) {}

  Workers workers;
  WallsWorkspace walls;
  ContactWorkspace contact;
  State repeated;  ///< of Scene::repeated, where sides repeat
};

/// Threads and scratch for steps, kept from step to step so that no step starts threads or allocates. They belong to no
/// state: any step of any state of the scene may use them, and no result depends on their contents.
struct Workspace {
  explicit Workspace(int threads = 1) : shared(threads) {}

  StageWorkspace shared;             ///< its threads share the loops of a stage
  std::deque<StageWorkspace> bands;  ///< one per thread, where threads advance bands side by side
  std::vector<StepRecord> records;   ///< of the steps in progress
  std::vector<int> near_plates;      ///< room for all particles; see NearCounts
};

}  // namespace cellcrush

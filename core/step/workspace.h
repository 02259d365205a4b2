#pragma once

#include <cstddef>
#include <deque>
#include <vector>

#include "beam/walls_workspace.h"
#include "cellcrush/array_shape.h"
#include "cellcrush/scene.h"
#include "parallel/workers.h"
#include "step/step_record.h"
#include "touch/contact_workspace.h"

namespace cellcrush {

/// Threads that share the loops of a stage, and its scratch.
struct StageWorkspace {
  explicit StageWorkspace(int threads = 1) : workers(threads) {}

  Workers workers;
  WallsWorkspace walls;
  ContactWorkspace contact;
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

/// Its arrays, listed as those of the scene are (cellcrush/scene_arrays.h). The walls' scratch is left out: one thread
/// needs it for a chunk only.
template <class Visitor>
void visit_arrays(const Workspace& workspace, Visitor&& visitor) {
  const auto& [shared, bands, records, near_plates] = workspace;
  visit_arrays(shared.contact, visitor);
  for (const StageWorkspace& of_thread : bands) {
    visit_arrays(of_thread.contact, visitor);
  }
  for (const StepRecord& record : records) {
    visit_arrays(record, visitor);
  }
  visitor("near_plates", near_plates, Per::particle);
}

}  // namespace cellcrush

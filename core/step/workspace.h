#pragma once

#include "beam/walls_workspace.h"
#include "contact/contact_workspace.h"
#include "parallel/workers.h"
#include "step/wide_motion.h"

namespace cellcrush {

/// Threads and room that the stages of a step work with, kept from step to step so that no step starts or allocates. It belongs to no state: any step
/// of any state of the scene may use it, and none depends on what it holds.
struct Workspace {
  explicit Workspace(int threads = 1) : workers(threads) {}

  Workers workers;
  MotionWorkspace motion;
  WallsWorkspace walls;
  ContactWorkspace contact;
};

}  // namespace cellcrush

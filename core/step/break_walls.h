#pragma once

#include <memory>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "fracture/failure.h"
#include "step/workspace.h"

namespace cellcrush {

/// Breaks walls between steps (E6g, fracture/part_walls.h): ends one path element of the method and begins the next.
class WallBreaker {
 public:
  /// REQUIRES: Scene::can_break.
  explicit WallBreaker(const Scene& scene) : search_(scene) {}

  /// Parts what has failed in the newest step. Returns the mesh from then on, or null if nothing has.
  std::shared_ptr<const Scene> break_walls(const Scene& scene, State& state, Workspace& workspace);

 private:
  FailureSearch search_;
};

}  // namespace cellcrush

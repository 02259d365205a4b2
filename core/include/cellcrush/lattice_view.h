#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush {

/// The specimen between its plates before loading, and where it has faults.
struct LatticeView {
  /// Mesh and plates only; null if the spec cannot be meshed. The plates are missing if its loading has problems.
  std::shared_ptr<const Scene> scene;
  Problems problems;               ///< as of build_scene
  std::vector<Vector2> crossings;  ///< of walls without a joint, mm; at most kMostCrossingPlaces
  std::optional<Vector2> slowest;  ///< middle of the wall that find_costly_walls would name, mm
};

inline constexpr std::size_t kMostCrossingPlaces = 1000;

/// Builds the view of a spec, also of one that cannot run because its walls cross.
LatticeView view_lattice(
    const SceneSpec& given, const std::function<void()>& between_stages = [] {});

}  // namespace cellcrush

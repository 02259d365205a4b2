#pragma once

#include <array>
#include <string>

#include "cellcrush/scene_spec.h"
#include "cellcrush/stage.h"

namespace cellcrush::bench {

/// What a crush took, from building the scene to its end, samples and frames included.
struct CrushCost {
  double elements = 0.0;
  double steps = 0.0;
  double strain = 0.0;                              ///< at which it ended
  double seconds = 0.0;                             ///< processor time of the run
  double build_seconds = 0.0;                       ///< processor time before it
  std::array<double, kStageCount> stage_seconds{};  ///< processor time in the stages
  double base_bytes = 0.0;   ///< resident before the scene was built, when a small crush has been done
  double build_bytes = 0.0;  ///< the most that was resident until the run began, beyond base_bytes
  double peak_bytes = 0.0;   ///< the same until the run's end
  double scene_bytes = 0.0;  ///< of the scene's arrays
  double state_bytes = 0.0;  ///< of the state's arrays at the end
};

/// Crushes in a process of its own, so that its memory is nothing else's, by a kernel. Throws
/// std::runtime_error when the crush did not reach its end.
CrushCost crush_apart(const SceneSpec& spec, const std::string& target);

}  // namespace cellcrush::bench

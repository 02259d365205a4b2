#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "cellcrush/sample.h"
#include "cellcrush/scene_spec.h"

namespace cellcrush::scenes {

/// What one seed of the imperfection makes of a crush.
struct SeededCrush {
  std::uint64_t seed = 0;
  CrushMode mode = CrushMode::none;  ///< that of the summary
  /// Depth of the collapsed cells, averaged in each of five strips along the crush, once 15 % of the cells have
  /// collapsed: greatest minus least strip, in cells. About 0 for straight layers, whatever find_crush_mode says.
  double unevenness = 0.0;
};

/// Crushes a lattice with seeds 1 to `count`, each until the share of collapsed cells passes kModeTo: the mode is known
/// by then.
std::vector<SeededCrush> crush_with_seeds(SceneSpec spec, double amplitude_mm, int count);

int count_of(const std::vector<SeededCrush>& crushes, CrushMode mode);

/// "seed 1 I 0.3, seed 2 V 4.1": mode and unevenness.
std::string describe(const std::vector<SeededCrush>& crushes);

}  // namespace cellcrush::scenes

#pragma once

#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Pairs of particles on the two sides of a lattice that face across the crush, in the middle half of its length, where
/// the plates do not hold it. The middle half is cut into rows; the outermost particles of a row before loading are a
/// pair. P pairs.
struct SidePairs {
  std::vector<int> low;   ///< P, particle
  std::vector<int> high;  ///< P, particle
};

/// Rows about `pitch` mm deep. REQUIRES: is_crushed(), pitch > 0.
SidePairs find_side_pairs(const Scene& scene, double pitch);

/// The lateral strain: mean over the pairs of how much farther they are apart across the crush than before loading,
/// over that distance. Positive where the lattice has become wider; 0 without pairs.
double lateral_strain_of(const SidePairs& pairs, const Scene& scene, const State& state);

}  // namespace cellcrush

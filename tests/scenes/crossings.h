#pragma once

#include <utility>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush::scenes {

/// Pairs of elements without a common node whose mid-lines cross: the proof that a wall has passed through another.
/// Exact geometry, by itself, without anything of the solver's search.
std::vector<std::pair<int, int>> find_crossings(const Scene& scene, const State& state);

}  // namespace cellcrush::scenes

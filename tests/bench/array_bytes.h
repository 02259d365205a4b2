#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush::bench {

/// Bytes that the arrays of a scene and of a state have room for, by name, the largest first.
std::vector<std::pair<std::string, double>> array_bytes(const Scene& scene, const State& state);

}  // namespace cellcrush::bench

#pragma once

#include <vector>

#include "cellcrush/scene_spec.h"
#include "cellcrush/vector.h"

namespace cellcrush {

/// Moves every joint by a uniformly distributed offset of at most the amplitude of the imperfection in x and in y. The
/// same seed gives the same offsets on every machine.
void perturb(const Imperfection& imperfection, std::vector<Vector2>& joints);

}  // namespace cellcrush

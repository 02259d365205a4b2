#pragma once

#include <vector>

#include "cellcrush/scene_spec.h"
#include "cellcrush/vector.h"

namespace cellcrush {

/// Moves every joint by at most the imperfection's amplitude in x and in y, drawn evenly. The same seed gives the same
/// offsets on every machine.
void perturb(const Imperfection& imperfection, std::vector<Vector2>& joints);

}  // namespace cellcrush

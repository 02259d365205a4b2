#pragma once

#include "cellcrush/scene_spec.h"
#include "scene/mesh.h"

namespace cellcrush {

/// Moves every joint by at most the imperfection's amplitude in x and in y, drawn evenly. The same seed gives the same
/// offsets on every machine.
void perturb(const Imperfection& imperfection, Layout& layout);

}  // namespace cellcrush

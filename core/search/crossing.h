#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Whether the centre lines of two elements without a common node cross.
bool cross_each_other(const State& state, const Element& one, const Element& other);

}  // namespace cellcrush

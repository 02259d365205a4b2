#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "parallel/workers.h"

namespace cellcrush {

/// The elements' part of evaluate_internal_forces with the processor's vector instructions, the walls of a block at once: the
/// same equations as evaluate_element. Returns false, and does nothing, for section rules that it is not compiled for.
bool evaluate_walls_wide(const Scene& scene, State& state, Workers& workers);

}  // namespace cellcrush

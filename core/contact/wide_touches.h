#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"

namespace cellcrush {

/// evaluate_touches with the processor's vector instructions, a pair a lane.
void evaluate_touches_wide(const Scene& scene, State& state, Touches& touches);

}  // namespace cellcrush

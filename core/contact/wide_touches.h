#pragma once

#include <cstddef>

#include "cellcrush/scene.h"
#include "cellcrush/state.h"
#include "contact/contact_workspace.h"

namespace cellcrush {

/// evaluate_touches with the processor's vector instructions, a pair a lane. Writes the pairs that have parted to
/// State::parted, ascending, and returns how many there are. REQUIRES: room for all pairs there.
std::size_t evaluate_touches_wide(const Scene& scene, State& state, Touches& touches);

}  // namespace cellcrush

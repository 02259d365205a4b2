#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Records the step in which particles of a frame could approach each other by the most, by E8c for all of them:
/// dt |v_high - v_low|. Does nothing where contacts are not watched (ContactLaw::most_travel).
void watch_approach(const Scene& scene, State& state);

}  // namespace cellcrush

#pragma once

#include "cellcrush/scene.h"
#include "cellcrush/state.h"

namespace cellcrush {

/// Sets the contacts' forces on a band's particles to 0, friction included: those of the step are added to it.
void clear_contact_forces(State& state, const LatticeBand& band);

}  // namespace cellcrush

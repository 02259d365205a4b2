#pragma once

#include "cellcrush/state.h"

namespace cellcrush {

/// Sets the contacts' forces on the particles `first` ... `end` to 0, friction included: those of the step are added to
/// it.
void clear_contact_forces(State& state, int first, int end);

}  // namespace cellcrush

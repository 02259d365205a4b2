#pragma once

#include "cellcrush/state.h"
#include "contact/contact_workspace.h"

namespace cellcrush {

/// Overwrites State::touching by the candidates that overlap now, with what is remembered of those that did before, and the
/// reach and the place among those before of ContactWorkspace::touches. Puts what touched before into
/// ContactWorkspace::before.
///
/// Without sorting: nearly all pairs touch for many steps, and each candidate knows where its pair stood when it last
/// touched. Only the others are sorted, and merged into the order that there is.
void remember_touches(State& state, ContactWorkspace& workspace);

}  // namespace cellcrush

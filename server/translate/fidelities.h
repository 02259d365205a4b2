#pragma once

#include "translate/check_case.h"

namespace cellcrush::translate {

/// Adds what a sound case would take and be worth at each fidelity to the answer of its check. `step_cost`: seconds of
/// one core for a step of an element. A case that asks for a fidelity is predicted by it. Meshes that the check knows
/// are not rebuilt. Adds none to a frame, for which nothing was measured. Throws std::bad_alloc when a mesh does not
/// fit.
void add_fidelities(const v1::Case& submitted, double step_cost, CaseCheck& check);

}  // namespace cellcrush::translate

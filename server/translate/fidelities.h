#pragma once

#include "cellcrush/v1/cases_service.pb.h"

namespace cellcrush::translate {

/// Adds what a sound case would take and be worth at each fidelity. `step_cost`: seconds of one core for a step of an
/// element. A case that asks for a fidelity is predicted by it. Throws std::bad_alloc when a scene does not fit.
void add_fidelities(const v1::Case& submitted, double step_cost, v1::CheckCaseResponse& response);

}  // namespace cellcrush::translate

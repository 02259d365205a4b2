#pragma once

#include <string>

#include "cellcrush/v1/cases_service.pb.h"

namespace cellcrush::client {

/// Predicted cost and error of a case at each fidelity, as a table with a line about the errors; empty without
/// fidelities.
std::string fidelity_text(const v1::CheckCaseResponse& check, int width);

}  // namespace cellcrush::client

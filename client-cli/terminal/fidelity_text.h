#pragma once

#include <string>

#include "cellcrush/v1/cases_service.pb.h"

namespace cellcrush::client {

/// What a case would take and be worth at each fidelity, as a table with a line on what the errors are; empty when
/// there are none.
std::string fidelity_text(const v1::CheckCaseResponse& check, int width);

}  // namespace cellcrush::client

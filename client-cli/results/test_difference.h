#pragma once

#include <string>

#include "cellcrush/v1/jobs_service.pb.h"

namespace cellcrush::client {

/// How tests and a job differ, as lines of a table: quantity with its unit, measured, computed, difference. `tests`:
/// the names of their files.
std::string difference_table(const v1::CompareTestResponse& difference, const std::string& tests);

}  // namespace cellcrush::client

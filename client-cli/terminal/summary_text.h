#pragma once

#include <string>

#include "cellcrush/v1/case.pb.h"
#include "cellcrush/v1/job.pb.h"
#include "cellcrush/v1/sample.pb.h"
#include "terminal/terminal.h"

namespace cellcrush::client {

/// Summary of a job's run. For a crush: plateau stresses with theory, front, crush mode and, for a slow one, how
/// quasi-static it was. For any run: energy ledger, contact and warnings.
std::string summary_text(const v1::Job& job, int width = terminal_width());

}  // namespace cellcrush::client
